// SPDX-License-Identifier: MIT
// Compares the package for the web in Node with the native library's SSE2 kernels, run in turns: plain arms, rows in cache, one thread.
//   tools/wasm/build && node bench/wasm.mjs [PACKAGE [SWIVEL_BENCH]]
// PACKAGE: the folder with index.js and swivel.wasm. SWIVEL_BENCH: the native benchmark. Both default to this repository's builds.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

const root = resolve(fileURLToPath(import.meta.url), '../..');
const [folder = `${root}/build/wasm/tools/wasm/package`, bench = `${root}/build/dev/bin/swivel-bench`] = process.argv.slice(2);
const { Field, load } = await import(pathToFileURL(`${resolve(folder)}/node.js`));

const median = (numbers) => [...numbers].sort((a, b) => a - b)[numbers.length >> 1];
const armCount = 4096;

const scratch = mkdtempSync(join(tmpdir(), 'swivel-'));
function native() {
  const out = join(scratch, 'result.json');
  execFileSync(bench, ['--benchmark_filter=^P/sse2/L2$', `--benchmark_out=${out}`, '--benchmark_min_time=0.2'], { stdio: 'ignore' });
  return 1e9 * JSON.parse(readFileSync(out, 'utf8')).benchmarks.find((row) => row.aggregate_name === 'median')['time/arm'];
}

const swivel = await load();
const crowd = swivel.crowd([armCount]);
crowd.write(Field.TARGET, Float32Array.from({ length: 3 * armCount }, () => 0.04 + 0.26 * Math.random()));
crowd.write(Field.POLE, [0.25, -1, 0.125]), crowd.write(Field.LENGTHS, [0.3, 0.26]);
function wasm() {
  const start = process.cpuUsage();  // microseconds of this process, as the native benchmark counts
  for (let arms = 0; ;) {
    for (let n = 0; n < 100; ++n) arms += crowd.solve();
    const { user, system } = process.cpuUsage(start);
    if (user + system > 2e5) return (user + system) * 1e3 / arms;
  }
}

const rounds = [];
for (let n = 0; n < 8; ++n) rounds.push({ native: native(), wasm: wasm() });
rmSync(scratch, { recursive: true });
rounds.shift();  // the engine compiles in the first
const nanoseconds = (name) => median(rounds.map((round) => round[name])).toFixed(2);
console.log(`native SSE2    ${nanoseconds('native')} ns an arm
wasm in Node   ${nanoseconds('wasm')} ns an arm, ${median(rounds.map((round) => round.native / round.wasm)).toFixed(2)} of the native rate
${rounds.length} rounds in turns, medians; Node ${process.version}`);
