// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
int main() { return 0; }
