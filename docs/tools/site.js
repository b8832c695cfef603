// What the theme leaves out for who cannot see or has no mouse: a name of its own for each navigation, a way into tables that scroll.
const mend = () => {
  const seen = new Set();
  for (const each of document.querySelectorAll("nav, [role=navigation]")) {
    const name = (each.dataset.name ??= each.getAttribute("aria-label") || each.title || (each.matches(".md-code__nav") ? "Code" : "Pages"));
    let own = name;
    for (let n = 2; seen.has(own); n++) own = `${name} ${n}`;
    seen.add(own);
    if (each.getAttribute("aria-label") !== own) each.setAttribute("aria-label", own);
    each.removeAttribute("aria-labelledby");
  }
  for (const each of document.querySelectorAll("th:empty")) each.setAttribute("role", "presentation");
  for (const each of document.querySelectorAll(".md-typeset__scrollwrap, .output, pre > code")) each.tabIndex = 0;
};
new MutationObserver(mend).observe(document.documentElement, { childList: true, subtree: true });
document.addEventListener("DOMContentLoaded", mend);
