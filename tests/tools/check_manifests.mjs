// node check_manifests.mjs TYPES.ts FILE.yaml...: holds rendered Kubernetes manifests to the schemas of the API.
// kubernetes-models checks values, and lets pass names that it does not know: those are left to its types, in
// TYPES.ts, which this writes and which does not compile where a field is misspelt. Prints what it found; ends
// with 1 where that is bad.
import {readFileSync, writeFileSync} from 'node:fs';
import {loadAll} from 'js-yaml';

const [types, ...files] = process.argv.slice(2);
let bad = files.length === 0;
let source = '';
let count = 0;
for (const file of files) {
  const manifests = loadAll(readFileSync(file, 'utf8'));
  for (const manifest of manifests) {
    const {kind, apiVersion, metadata} = manifest;
    const module = `kubernetes-models/${apiVersion}`;
    try {
      const models = await import(module);
      new models[kind](manifest).validate();
    } catch (error) {
      console.log(`${file}: ${kind} ${metadata?.name}: ${error.message}`);
      bad = true;
    }
    ++count;
    source += `import type {I${kind} as Type${count}} from '${module}';\n`;
    source += `export const manifest${count}: Type${count} = ${JSON.stringify(manifest)};\n`;
  }
  console.log(`${file}: ${manifests.map((manifest) => manifest.kind).join(', ')}`);
}
writeFileSync(types, source);
process.exitCode = bad ? 1 : 0;
