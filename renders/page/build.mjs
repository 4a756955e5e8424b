// Makes the scripts and styles of the pages: node build.mjs [--modules DIR] OUTDIR
//
//   viewer.js, viewer.css             the open case of a report
//   play.html, play.js, play.css      the playground of `contort serve`
//   live.js, live.css                 what a served report can do beside
//
// DIR is the node_modules folder where `npm ci` was run, if that is not next to this file. Each page has one classic
// script, because browsers refuse modules, workers and fetch for pages that are opened from a disk.
import { createRequire } from 'node:module';
import { copyFileSync, existsSync, mkdirSync, readFileSync, statSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));

function readArguments(words) {
  const options = { modules: join(here, 'node_modules'), out: '' };
  for (let i = 0; i < words.length; ++i) {
    if (words[i] === '--modules' && i + 1 < words.length) options.modules = resolve(words[++i]);
    else if (!words[i].startsWith('-') && !options.out) options.out = resolve(words[i]);
    else return null;
  }
  return options.out ? options : null;
}

// Both licences ask that their text goes along with every copy.
function licences(modules) {
  const text = (name) => readFileSync(join(modules, name, 'LICENSE'), 'utf8').trim().replaceAll('\u00a9', '(c)');
  const texts = ['three', 'uplot'].map((name) => `${name}\n\n${text(name)}`);
  return `/*!\nParts of this file are three.js and uPlot.\n\n${texts.join('\n\n').replaceAll('*/', '* /')}\n*/`;
}

// Name of the outputs: where they begin, and what a page can call of them.
const kBundles = {
  viewer: { entry: ['src', 'main.js'], globalName: 'contortViewer' },
  play: { entry: ['play', 'main.js'] },
  live: { entry: ['live', 'main.js'], own: true },
};

async function bundle(esbuild, { modules, out }, name, { entry, globalName, own }) {
  await esbuild.build({
    entryPoints: [join(here, ...entry)],
    outfile: join(out, `${name}.js`),
    bundle: true,
    minify: true,
    format: 'iife',
    globalName,
    target: ['chrome100', 'firefox100', 'safari15.4'],
    charset: 'ascii',  // The page may be read with any encoding guess.
    legalComments: 'eof',
    footer: own ? {} : { js: licences(modules) },
    nodePaths: [modules],
    absWorkingDir: here,
    logLevel: 'warning',
  });
  for (const kind of ['js', 'css']) console.log(`${name}.${kind}: ${statSync(join(out, `${name}.${kind}`)).size} bytes`);
}

async function build(options) {
  const { modules, out } = options;
  const esbuild = await import(pathToFileURL(createRequire(join(modules, 'x.js')).resolve('esbuild')).href);
  mkdirSync(out, { recursive: true });
  for (const [name, what] of Object.entries(kBundles)) await bundle(esbuild.default, options, name, what);
  copyFileSync(join(here, 'play', 'play.html'), join(out, 'play.html'));
}

const options = readArguments(process.argv.slice(2));
if (!options) {
  console.error('usage: node build.mjs [--modules DIR] OUTDIR');
  process.exit(2);
}
if (!existsSync(join(options.modules, 'esbuild'))) {
  console.error(`build.mjs: no esbuild in ${options.modules}: run npm ci where package.json is, or give --modules DIR`);
  process.exit(1);
}
await build(options);
