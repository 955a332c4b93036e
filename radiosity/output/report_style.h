// The style sheet of report.html.
#pragma once

namespace lambert {

inline constexpr char kReportStyle[] = R"css(
:root { color-scheme: light dark; --ink: #1c1e21; --soft: #62686f; --paper: #ffffff; --line: #e1e4e8;
  --panel: #f6f7f8; --accent: #b45309; --second: #1d6fa5; }
@media (prefers-color-scheme: dark) { :root { --ink: #e8e6e3; --soft: #9aa0a6; --paper: #16181b;
  --line: #30343a; --panel: #1e2125; --accent: #f2a541; --second: #6cb6e8; } }
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 2.5rem 1.5rem 4rem; max-width: 1020px; background: var(--paper);
  color: var(--ink); font: 15px/1.55 system-ui, "Segoe UI", "Helvetica Neue", Arial, sans-serif; }
h1 { font-size: 1.7rem; font-weight: 650; letter-spacing: -0.01em; margin: 0; }
h2 { font-size: 1.08rem; font-weight: 650; margin: 2.6rem 0 0.7rem; }
p { margin: 0.4rem 0; max-width: 46rem; }
.soft, figcaption, .note { color: var(--soft); }
figcaption, .note { font-size: 0.87rem; margin-top: 0.5rem; }
.tiles { display: grid; grid-template-columns: repeat(auto-fit, minmax(150px, 1fr)); gap: 1px;
  background: var(--line); border: 1px solid var(--line); border-radius: 8px; overflow: hidden;
  margin: 1.5rem 0; }
.tiles div { background: var(--paper); padding: 0.75rem 1rem; }
.tiles b { display: block; font-size: 1.25rem; font-weight: 600; white-space: nowrap;
  font-variant-numeric: tabular-nums; }
.tiles span { color: var(--soft); font-size: 0.83rem; }
figure { margin: 0; }
img { display: block; width: 100%; height: auto; border-radius: 6px; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-size: 0.91rem; }
th { text-align: left; font-weight: 600; color: var(--soft); white-space: nowrap; }
th, td { padding: 0.34rem 0.9rem 0.34rem 0; border-bottom: 1px solid var(--line);
  vertical-align: top; overflow-wrap: break-word; }
td:first-child { min-width: 6.5rem; }
td.n, th.n { text-align: right; white-space: nowrap; font-variant-numeric: tabular-nums; }
td.fact { white-space: nowrap; color: var(--soft); padding-right: 2rem; width: 1%; }
code { font: 0.86em ui-monospace, "DejaVu Sans Mono", Menlo, monospace; }
.warning { border-left: 3px solid var(--accent); background: var(--panel); padding: 0.5rem 0.9rem;
  margin: 0.5rem 0; border-radius: 0 6px 6px 0; }
svg { display: block; width: 100%; height: auto; }
svg text { fill: var(--soft); font: 12px system-ui, "Segoe UI", Arial, sans-serif; }
svg .grid { stroke: var(--line); stroke-width: 1; }
svg .level { stroke: var(--soft); stroke-width: 1; stroke-dasharray: 5 4; }
svg .estimate { stroke: var(--accent); } svg .true { stroke: var(--second); }
svg line.estimate, svg line.true { stroke-width: 2; }
svg polyline { fill: none; stroke-width: 2; stroke-linejoin: round; }
svg circle.estimate { fill: var(--accent); stroke: none; }
svg circle.true { fill: var(--second); stroke: none; }
td.fact + td { overflow-wrap: anywhere; }
@page { margin: 14mm; }
@media print { :root { --ink: #000; --soft: #444; --paper: #fff; --line: #bbb; --panel: #fff;
  --accent: #b45309; --second: #1d6fa5; } figure, tr, .tiles, .warning { break-inside: avoid; }
  tr:nth-last-child(-n + 2) { break-before: avoid; }
  body { padding: 0; max-width: none; font-size: 12px; print-color-adjust: exact; }
  h2 { break-after: avoid; margin-top: 1.4rem; } img { width: auto; max-width: 100%;
  max-height: 9.4cm; margin: 0 auto; } figcaption, h2 + figure { text-align: center; }
  figure svg { max-width: 15cm; margin: 0 auto; }
  .tiles { grid-template-columns: repeat(5, 1fr); } .scroll { overflow-x: visible; }
  th, td { padding-right: 0.5rem; overflow-wrap: break-word; } th { white-space: normal; } }
)css";

}  // namespace lambert
