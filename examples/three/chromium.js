// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Shows a page to headless Chromium (or $CHROMIUM), without a GPU, and waits for what it posts.
import { spawn } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { basename, extname, join } from 'node:path';

const types = { '.html': 'text/html', '.js': 'text/javascript' };

export function fail(code, message) {
  console.error(`${basename(process.argv[1])}: ${message}`);
  process.exit(code);
}

export function attempt(code, work) {
  try {
    return work();
  } catch (error) {
    return fail(code, error.message);
  }
}

// A folder that goes when the program does.
export function temporaryFolder() {
  const folder = mkdtempSync(join(tmpdir(), 'ltcfit-three-'));
  process.on('exit', () => rmSync(folder, { recursive: true, force: true, maxRetries: 9 }));
  return folder;
}

// answer(path): the bytes of a file, or an exception. finish(result): of what the page posts, JSON
// with its `errors`; those are told and end the program.
export function showPage(page, answer, finish, flags = []) {
  let browser;
  const profile = temporaryFolder();
  // Chromium leaves in its own time, so that nothing writes to its profile when that is removed.
  const end = (result) => browser.removeAllListeners('exit').on('exit', () => {
    if (result.errors.length) fail(1, result.errors.join('\n'));
    finish(result);
    process.exit(0);
  }).kill();
  const serve = (request, response) => {
    const { pathname } = new URL(request.url, 'http://localhost');
    if (request.method === 'POST') {
      let body = '';
      request.on('data', (part) => { body += part; }).on('end', () => end(JSON.parse(body)));
      return;
    }
    try {
      const bytes = answer(pathname);
      response.writeHead(200, { 'Content-Type': types[extname(pathname)] ?? 'application/octet-stream' })
        .end(bytes);
    } catch {
      response.writeHead(404).end();
    }
  };
  const server = createServer(serve).listen(0, '127.0.0.1', () => {
    browser = spawn(process.env.CHROMIUM ?? 'chromium', [
      '--headless', '--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader',
      '--enable-unsafe-swiftshader', '--disable-gpu-watchdog', ...flags, `--user-data-dir=${profile}`,
      `http://127.0.0.1:${server.address().port}/${page}`], { stdio: 'ignore' });
    browser.on('error', (error) => fail(1, `no Chromium: ${error.message}`));
    browser.on('exit', (code) => fail(1, `Chromium ended with ${code}`));
    setTimeout(() => end({ errors: ['the page did not end within 20 minutes'] }), 1_200_000);
  });
}
