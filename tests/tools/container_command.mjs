// node container_command.mjs FILE.yaml KIND: what the first container of the manifest of that kind runs, the command
// and its arguments, one a line.
import {readFileSync} from 'node:fs';
import {loadAll} from 'js-yaml';

const [file, kind] = process.argv.slice(2);
const manifest = loadAll(readFileSync(file, 'utf8')).find((found) => found.kind === kind);
const {command, args} = manifest.spec.template.spec.containers[0];
console.log([...command, ...args].join('\n'));
