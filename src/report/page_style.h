// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The style sheet of a report's page.
#pragma once

#include <string_view>

namespace ltc::html {

// Colours are named once and change with the reader's preference. Pictures keep their white ground:
// their colour maps are made for it. No < or & within, so that XML reads it too.
inline constexpr std::string_view page_style = R"css(
:root {
  --ground: #ffffff; --card: #f5f6f7; --line: #dcdfe3; --ink: #22252a; --faint: #5f6670;
  --good: #00703c; --good-ground: #e2f3ea; --bad: #b3261e; --bad-ground: #fbe6e4;
  --code: #eceef0;
}
@media (prefers-color-scheme: dark) {
  :root {
    --ground: #16181c; --card: #1f2227; --line: #383d45; --ink: #e6e8eb; --faint: #a2a9b3;
    --good: #6fd39b; --good-ground: #163526; --bad: #ff9d94; --bad-ground: #46201d;
    --code: #2a2e35;
  }
}
* { box-sizing: border-box; }
body { margin: 0; background: var(--ground); color: var(--ink);
  font: 16px/1.55 system-ui, "Segoe UI", Roboto, "DejaVu Sans", sans-serif; }
main { max-width: 1120px; margin: 0 auto; padding: 32px 24px 64px; }
h1 { font-size: 28px; line-height: 1.2; margin: 0 0 4px; overflow-wrap: anywhere; }
h2 { font-size: 21px; margin: 48px 0 8px; padding-top: 16px; border-top: 1px solid var(--line); }
h3 { font-size: 16px; margin: 28px 0 6px; }
p { margin: 6px 0 12px; max-width: 78ch; }
.faint, figcaption { color: var(--faint); }
.sentence { display: block; margin: 18px 0; padding: 14px 18px; border-radius: 10px;
  font-size: 18px; font-weight: 600; }
.sentence.passed, .verdict.passed { color: var(--good); background: var(--good-ground); }
.sentence.failed, .verdict.failed { color: var(--bad); background: var(--bad-ground); }
.sentence ul { margin: 6px 0 0; padding-left: 22px; font-size: 15px; font-weight: 400; }
.verdict { padding: 2px 9px; border-radius: 10px; font-size: 14px; white-space: nowrap; }
.verdict.unchecked { color: var(--faint); background: var(--code); }
.tiles { display: grid; grid-template-columns: repeat(auto-fit, minmax(225px, 1fr)); gap: 14px;
  margin: 18px 0; }
.tile { background: var(--card); border: 1px solid var(--line); border-radius: 10px;
  padding: 14px 16px; }
.tile b { display: block; font-size: 30px; line-height: 1.25; font-variant-numeric: tabular-nums; }
.tile span { display: block; font-size: 14px; color: var(--faint); }
.wide { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; min-width: 760px; font-size: 14.5px;
  margin: 8px 0 16px; }
th, td { text-align: left; padding: 6px 14px 6px 0; border-bottom: 1px solid var(--line);
  vertical-align: top; }
th { color: var(--faint); font-weight: 600; }
.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
code { font: 13px/1.5 ui-monospace, "DejaVu Sans Mono", monospace; background: var(--code);
  padding: 1px 5px; border-radius: 4px; overflow-wrap: anywhere; }
pre { background: var(--code); border-radius: 8px; padding: 12px 14px; overflow-x: auto;
  font: 13px/1.5 ui-monospace, "DejaVu Sans Mono", monospace; }
figure { margin: 16px 0 22px; }
figure img { display: block; width: 100%; height: auto; background: #ffffff;
  border: 1px solid var(--line); border-radius: 10px; }
figcaption { font-size: 14px; margin-top: 6px; }
.pair { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(480px, 100%), 1fr));
  gap: 16px; }
.pair figure { margin: 0; }
summary { cursor: pointer; color: var(--faint); }
@media (max-width: 640px) {
  main { padding: 20px 14px 48px; }
  table { min-width: 0; }
  thead { display: none; }
  table, tbody, tr, td { display: block; }
  tr { border-bottom: 1px solid var(--line); padding: 8px 0; }
  td { border: 0; padding: 1px 0; text-align: left; white-space: normal; overflow-wrap: anywhere; }
  td.number { text-align: left; white-space: normal; }
  td:first-child { font-weight: 600; }
  td:empty { display: none; }
  td[data-head]:not(:first-child)::before { content: attr(data-head); display: inline-block;
    min-width: 8em; padding-right: 10px; color: var(--faint); }
}
@media print { main { max-width: none; } h2 { break-after: avoid; } figure { break-inside: avoid; } }
)css";

}  // namespace ltc::html
