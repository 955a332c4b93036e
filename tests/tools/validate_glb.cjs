// node validate_glb.cjs [--errors] FILE.glb...: prints what the Khronos validator says of each file; ends with 1
// where it finds an error or, without --errors, a warning, but for pictures that MOZ_texture_rgbe brings: it knows PNG
// and JPEG alone.
const fs = require('fs');
const validator = require('gltf-validator');

async function main([first, ...others]) {
  const most = first === '--errors' ? 0 : 1;  // severity
  const files = first === '--errors' || first === undefined ? others : [first, ...others];
  let bad = files.length === 0;
  for (const file of files) {
    const bytes = fs.readFileSync(file);
    const report = await validator.validateBytes(new Uint8Array(bytes));
    const {numErrors, numWarnings, messages} = report.issues;
    const {images = []} = JSON.parse(bytes.subarray(20, 20 + bytes.readUInt32LE(12)).toString());
    const isRgbe = (pointer) => images[/^\/images\/(\d+)/.exec(pointer)?.[1]]?.mimeType === 'image/vnd.radiance';
    console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings`);
    for (const message of messages) {
      if (message.severity > most) continue;  // 0: error, 1: warning, 2: information, 3: hint
      if (message.severity === 1 && isRgbe(message.pointer)) continue;
      console.log(`  ${message.code} at ${message.pointer}: ${message.message}`);
      bad = true;
    }
  }
  process.exitCode = bad ? 1 : 0;
}

main(process.argv.slice(2));
