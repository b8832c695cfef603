"""How the report looks: on a screen, light or dark, wide or narrow, and on paper."""

CSS = """
:root {
  color-scheme: light;
  --page: #ffffff; --ink: #1d2328; --soft: #55606b; --line: #d8dee4; --panel: #f5f7f9; --link: #0b5c99;
  --warn: #fff4d6; --warn-line: #b8860b;
}
@media screen and (prefers-color-scheme: dark) {
  :root {
    color-scheme: dark;
    --page: #14181c; --ink: #e4e8ec; --soft: #a3adb7; --line: #343b43; --panel: #1d2228; --link: #7db8ec;
    --warn: #3a3016; --warn-line: #d9a93a;
  }
}
* { box-sizing: border-box; }
body {
  margin: 0 auto; padding: 2rem 1.25rem 4rem; max-width: 64rem; background: var(--page); color: var(--ink);
  font: 16px/1.55 system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif;
  -webkit-text-size-adjust: 100%;
}
h1 { font-size: 1.75rem; line-height: 1.25; margin: 0 0 .5rem; text-wrap: balance; }
h2 { font-size: 1.3rem; line-height: 1.3; margin: 3rem 0 .75rem; padding-bottom: .3rem;
     border-bottom: 1px solid var(--line); }
h3 { font-size: 1.05rem; line-height: 1.35; margin: 2rem 0 .5rem; }
p, ul, ol, dl { margin: .6rem 0; }
a { color: var(--link); }
.lead, .note { color: var(--soft); }
.note { font-size: .9rem; }
nav { font-size: .95rem; margin: 1rem 0; }
nav a { display: inline-block; margin-right: 1.1rem; padding: .2rem 0; }
code, pre { font: .9em/1.5 ui-monospace, SFMono-Regular, Menlo, Consolas, monospace; }
code { overflow-wrap: anywhere; }
pre { background: var(--panel); border: 1px solid var(--line); border-radius: 6px; padding: .7rem .9rem;
      margin: .6rem 0; white-space: pre-wrap; overflow-wrap: anywhere; }
.warning { background: var(--warn); border-left: 4px solid var(--warn-line); border-radius: 4px; padding: .7rem 1rem;
           margin: 1.2rem 0; }
dl.facts { display: grid; grid-template-columns: max-content 1fr; gap: .25rem 1.25rem; }
dl.facts dt { color: var(--soft); }
dl.facts dd { margin: 0; overflow-wrap: anywhere; }
ul.counts { display: flex; flex-wrap: wrap; gap: .75rem; list-style: none; padding: 0; margin: 1rem 0; }
ul.counts li { flex: 1 1 8rem; background: var(--panel); border: 1px solid var(--line); border-radius: 8px;
               padding: .7rem .9rem; }
ul.counts b { display: block; font-size: 1.7rem; line-height: 1.2; }
.badge { display: inline-block; padding: .12rem .6rem; border-radius: 1rem; font-size: .82rem; font-weight: 600;
         line-height: 1.5; white-space: nowrap; color: #fff; background: #57606a; print-color-adjust: exact;
         -webkit-print-color-adjust: exact; }
.badge.holds { background: #0a6b4b; }
.badge.partly { background: #865300; }
.badge.fails { background: #a3330b; }
table { border-collapse: collapse; width: 100%; font-size: .9rem; line-height: 1.45; margin: .75rem 0; }
caption { text-align: left; color: var(--soft); padding-bottom: .4rem; }
th, td { text-align: left; vertical-align: top; padding: .45rem .6rem; border-bottom: 1px solid var(--line); }
th { font-weight: 600; border-bottom-width: 2px; vertical-align: bottom; }
th.number, td.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
th .unit { display: block; font-weight: 400; color: var(--soft); }
td .key { display: block; color: var(--soft); margin-top: .15rem; font-variant-numeric: tabular-nums; }
table.claims th:nth-child(1) { width: 3.5em; }
table.claims th:nth-child(2) { width: 27%; }
table.claims th:nth-child(4) { width: 9.5em; }
table.claims th:nth-child(5) { width: 17%; }
table.both th:nth-child(2) { width: 20%; }
table.both th:nth-child(3), table.both th:nth-child(4) { width: 32%; }
table.both th:nth-child(5) { width: auto; }
td .measured { display: block; margin-top: .3rem; }
th.number { white-space: normal; }
.scroll table { font-size: .8rem; }
.scroll th, .scroll td { padding: .35rem .4rem; }
.scroll td { vertical-align: middle; }
.scroll td:first-child { white-space: nowrap; }
.scroll { overflow-x: auto; }
figure { margin: 1rem 0 2.5rem; }
figure .scroll { background: #fff; border: 1px solid var(--line); border-radius: 8px; padding: .9rem; }
figure img { display: block; height: auto; max-width: 100%; margin: 0 auto; }
figcaption { font-size: .92rem; margin-top: .6rem; }
figcaption .note { display: block; margin-top: .3rem; }
footer { margin-top: 3rem; border-top: 1px solid var(--line); }
@media screen and (max-width: 45rem) {
  body { padding: 1.25rem 1rem 3rem; }
  h1 { font-size: 1.4rem; }
  dl.facts { grid-template-columns: 1fr; gap: 0; }
  dl.facts dd { margin-bottom: .5rem; }
  ul.counts li { flex-basis: 40%; }
  figure .scroll { padding: .5rem; margin: 0 -.5rem; }
  figure.wide img { max-width: none; }
  figure.wide .note::after { content: " Swipe the figure sideways to see all of it."; }
  table.claims, table.claims tbody, table.claims tr, table.claims td { display: block; }
  table.claims thead { display: none; }
  table.claims tr { border: 1px solid var(--line); border-radius: 8px; padding: .6rem .8rem; margin: .8rem 0; }
  table.claims td { border: 0; padding: .15rem 0; }
  table.claims td:first-child { font-weight: 700; }
  table.claims td[data-label]::before { content: attr(data-label); color: var(--soft); }
}
@media print {
  @page { size: A4; margin: 15mm 14mm; }
  body { max-width: none; padding: 0; font-size: 10pt; line-height: 1.4; }
  nav { display: none; }
  h1 { font-size: 18pt; }
  h2 { font-size: 13pt; margin-top: 1.6rem; }
  h2, h3, caption { break-after: avoid; }
  figure, tr, pre, .warning, ul.counts, dl.facts { break-inside: avoid; }
  thead { display: table-header-group; }
  figure { margin: .6rem 0 1.4rem; }
  figure .scroll { border: 0; padding: 0; overflow: visible; }
  figure img { max-width: 100%; max-height: 215mm; width: auto; }
  table { font-size: 8.5pt; }
  .badge { font-size: 7.5pt; padding: 0 .5em; }
  table.claims th:nth-child(4) { width: 8.5em; }
  th, td { padding: .25rem .4rem; }
  .scroll { overflow: visible; }
  a { color: inherit; text-decoration: none; }
}
"""
