// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Prints as JSON what ktx-parse finds in a KTX 2.0 file, bytes as hexadecimal: ktx_parse.mjs FILE
import { readFileSync } from "node:fs";
import { read } from "ktx-parse";

const found = read(new Uint8Array(readFileSync(process.argv[2])));
console.log(JSON.stringify(found, (_, value) =>
  value instanceof Uint8Array ? Buffer.from(value).toString("hex") : value));
