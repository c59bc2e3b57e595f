// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Opens a page in headless Chromium (or $CHROMIUM) and does there what a JSON file of steps says:
//   node drive.mjs PAGE STEPS.json [CHROMIUM'S OPTIONS...]
// Prints the values that steps ask for, by their names, and the page's errors, as JSON. Exit code 1:
// the browser or a step failed.
import { spawn } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const [page, stepsFile, ...options] = process.argv.slice(2);
const address = pathToFileURL(resolve(page)).href;
const patience = 600_000;  // only a hang comes to its end
const profile = mkdtempSync(join(tmpdir(), 'ltcfit-viewer-'));
process.on('exit', () => rmSync(profile, { recursive: true, force: true, maxRetries: 9 }));

const browser = spawn(process.env.CHROMIUM ?? 'chromium', [
  '--headless', '--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
  '--disable-gpu-watchdog', '--hide-scrollbars', '--remote-debugging-pipe', `--user-data-dir=${profile}`,
  ...options, 'about:blank'], { stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'] });
browser.on('error', (error) => end(1, `no Chromium: ${error.message}`));
browser.on('exit', (code) => end(1, `Chromium ended with ${code}`));

function end(code, message) {
  if (message) console.error(`drive.mjs: ${message}`);
  // Chromium leaves in its own time, so that nothing writes to its profile when that is removed.
  if (browser.exitCode !== null || code === 1) { browser.kill('SIGKILL'); process.exit(code); }
  browser.removeAllListeners('exit').on('exit', () => process.exit(code)).kill();
}

// ---- The DevTools protocol over pipes: JSON with a zero byte behind ----

const waiting = new Map(), errors = [];
let last = 0, rest = Buffer.alloc(0), session;
browser.stdio[4].on('data', (part) => {
  rest = Buffer.concat([rest, part]);
  for (let at; (at = rest.indexOf(0)) >= 0; rest = rest.subarray(at + 1)) hear(JSON.parse(rest.subarray(0, at)));
});

function hear({ id, result, error, method, params }) {
  if (method === 'Runtime.exceptionThrown')
    errors.push(params.exceptionDetails.exception?.description ?? params.exceptionDetails.text);
  if (!waiting.has(id)) return;
  const { done, failed } = waiting.get(id);
  waiting.delete(id);
  if (error) failed(new Error(error.message)); else done(result);
}

function ask(method, params = {}) {
  const id = ++last;
  browser.stdio[3].write(JSON.stringify({ id, method, params, sessionId: session }) + '\0');
  return new Promise((done, failed) => waiting.set(id, { done, failed }));
}

async function valueOf(expression) {
  const { result, exceptionDetails } = await ask('Runtime.evaluate',
    { expression, awaitPromise: true, returnByValue: true, userGesture: true });
  if (exceptionDetails) throw new Error(`${expression}: ${exceptionDetails.exception?.description}`);
  return result.value;
}

async function until(expression) {
  for (const began = Date.now(); Date.now() - began < patience;) {
    if (await valueOf(expression)) return;
    await new Promise((done) => setTimeout(done, 50));
  }
  throw new Error(`${expression} did not come true`);
}

// ---- Steps ----

const values = {};
const steps = {
  // Anew, whatever the fragment.
  open: async (fragment) => {
    await ask('Page.navigate', { url: 'about:blank' });
    await until('location.href === "about:blank"');
    await ask('Page.navigate', { url: address + fragment });
    await until('location.href !== "about:blank" && document.readyState === "complete"');
  },
  before: (source) => ask('Page.addScriptToEvaluateOnNewDocument', { source }),
  until,
  do: valueOf,
  value: async ([name, expression]) => { values[name] = await valueOf(expression); },
  size: ([width, height, deviceScaleFactor = 1]) => ask('Emulation.setDeviceMetricsOverride',
    { width, height, deviceScaleFactor, mobile: false }),
  dark: (dark) => ask('Emulation.setEmulatedMedia',
    { features: [{ name: 'prefers-color-scheme', value: dark ? 'dark' : 'light' }] }),
  key: async ([key, modifiers = 0]) => {
    for (const type of ['keyDown', 'keyUp'])
      await ask('Input.dispatchKeyEvent', { type, key, code: key, modifiers,
        windowsVirtualKeyCode: { ArrowLeft: 37, ArrowUp: 38, ArrowRight: 39, ArrowDown: 40, Tab: 9 }[key] ?? 0 });
  },
  mouse: ([type, x, y]) => ask('Input.dispatchMouseEvent', { type, x, y, clickCount: 1,
    button: type === 'mouseMoved' ? 'none' : 'left', buttons: type === 'mouseReleased' ? 0 : 1 }),
  drag: ([x, y]) => ask('Input.dispatchMouseEvent', { type: 'mouseMoved', x, y, button: 'left', buttons: 1 }),
  screenshot: async (file) => {
    const { data } = await ask('Page.captureScreenshot', { format: 'png' });
    writeFileSync(file, Buffer.from(data, 'base64'));
  },
};

async function run() {
  const { targetInfos } = await ask('Target.getTargets');
  const { targetId } = targetInfos.find(({ type }) => type === 'page');
  session = (await ask('Target.attachToTarget', { targetId, flatten: true })).sessionId;
  await ask('Page.enable');
  await ask('Runtime.enable');
  for (const step of JSON.parse(readFileSync(stepsFile, 'utf8')))
    for (const [name, value] of Object.entries(step)) await steps[name](value);
  console.log(JSON.stringify({ ...values, errors }));
}

run().then(() => end(0), (error) => end(1, [error.message, ...errors].join('\n')));
