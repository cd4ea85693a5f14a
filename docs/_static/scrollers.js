// Lets the keyboard reach what is wider than its place, tables and code, so that the arrow keys can scroll it.
// Nothing else becomes a stop of the Tab key, and browsers that do this by themselves lose nothing.
const reach = () => {
  for (const box of document.querySelectorAll("pre, .table-wrapper, .convergence .values")) {
    if (box.scrollWidth > box.clientWidth || box.scrollHeight > box.clientHeight) box.tabIndex = 0;
    else box.removeAttribute("tabindex");
  }
};
reach();
addEventListener("resize", reach);
// What is folded away has no size before it is opened.
document.addEventListener("toggle", reach, true);
