// node container_command.mjs FILE.yaml NAME: what the first container of the manifest of that name runs that has pods,
// the command and its arguments, one a line.
import {readFileSync} from 'node:fs';
import {loadAll} from 'js-yaml';

const [file, name] = process.argv.slice(2);
const manifest = loadAll(readFileSync(file, 'utf8')).find(
    (found) => found.metadata.name === name && found.spec?.template !== undefined);
const {command, args} = manifest.spec.template.spec.containers[0];
console.log([...command, ...args].join('\n'));
