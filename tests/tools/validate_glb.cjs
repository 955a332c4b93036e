// node validate_glb.cjs FILE.glb...: prints what the Khronos validator says of each file; ends with 1
// where it finds an error or a warning.
const fs = require('fs');
const validator = require('gltf-validator');

async function main(files) {
  let bad = files.length === 0;
  for (const file of files) {
    const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)));
    const {numErrors, numWarnings, messages} = report.issues;
    console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings`);
    for (const message of messages) {
      if (message.severity > 1) continue;  // 2: information, 3: hint
      console.log(`  ${message.code} at ${message.pointer}: ${message.message}`);
      bad = true;
    }
  }
  process.exitCode = bad ? 1 : 0;
}

main(process.argv.slice(2));
