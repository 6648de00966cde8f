// A formula that is wider than its column is set smaller, down to this share of its size. What is wider still scrolls.
const LEAST_SIZE = 0.6;

function fitFormulas() {
  for (const formula of document.querySelectorAll(".math:has(mjx-container)")) {
    formula.style.fontSize = "";
    formula.classList.remove("too-wide");
    const room = formula.closest("p, li, td, dd, div").clientWidth;
    const drawn = [...formula.querySelectorAll("svg")].map((picture) => picture.getBoundingClientRect().width);
    const share = (0.96 * room) / Math.max(...drawn); // letters have whole pixels, so sizes are not quite in proportion
    if (room && share < 1) formula.style.fontSize = `${100 * Math.max(share, LEAST_SIZE)}%`;
    if (room && share < LEAST_SIZE) formula.classList.add("too-wide");
  }
}

addEventListener("load", () => window.MathJax?.startup?.promise.then(fitFormulas));
addEventListener("resize", fitFormulas);
addEventListener("toggle", fitFormulas, true); // what was folded had no width
