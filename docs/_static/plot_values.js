// Shows the values of the mark that is nearest to the pointer, and lets the arrow keys go from mark to mark: left and
// right along a line, up and down from line to line. Without this script the numbers stand in a table.
const HINT = "Point at a plot, or press the arrow keys in it, to read its values.";

class Values {
  constructor(plot) {
    this.plot = plot;
    this.svg = plot.querySelector("svg");
    this.lines = [...plot.querySelectorAll(".curve")]
      .map((line) => [...line.querySelectorAll("[data-values]")])
      .filter((marks) => marks.length > 0);
    this.line = this.number = 0;
    this.ring = document.createElementNS(this.svg.namespaceURI, "circle");
    this.ring.setAttribute("class", "ring");
    this.ring.setAttribute("r", 8);
    this.readout = document.createElement("div");
    this.readout.className = "readout";
    this.readout.setAttribute("aria-live", "polite");
    plot.append(this.readout);

    plot.tabIndex = 0;
    plot.setAttribute("role", "application");
    plot.setAttribute("aria-label", this.svg.getAttribute("aria-label") + ". Arrow keys read its values.");
    plot.addEventListener("pointermove", (event) => this.follow(event));
    plot.addEventListener("pointerdown", (event) => this.follow(event));
    plot.addEventListener("pointerleave", (event) => {
      // A finger that was lifted leaves what it showed.
      if (event.pointerType === "mouse") this.hide();
    });
    plot.addEventListener("keydown", (event) => this.press(event));
    plot.addEventListener("focus", () => {
      if (plot.matches(":focus-visible")) this.show();
    });
    plot.addEventListener("blur", () => this.hide());
  }

  mark() {
    return this.lines[this.line][this.number];
  }

  // The mark nearest to the pointer, wherever in the plot it is.
  follow(event) {
    const box = this.svg.getBoundingClientRect();
    const scale = this.svg.viewBox.baseVal.width / box.width;
    const x = (event.clientX - box.left) * scale;
    const y = (event.clientY - box.top) * scale;
    let least = Infinity;
    this.lines.forEach((marks, line) =>
      marks.forEach((mark, number) => {
        const distance = Math.hypot(mark.dataset.x - x, mark.dataset.y - y);
        if (distance < least) [least, this.line, this.number] = [distance, line, number];
      }),
    );
    this.show();
  }

  press(event) {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const along = { ArrowLeft: -1, ArrowRight: 1, Home: -Infinity, End: Infinity }[event.key];
    const across = { ArrowUp: -1, ArrowDown: 1 }[event.key];
    if (event.key === "Escape") return this.hide();
    if (along === undefined && across === undefined) return;
    event.preventDefault();
    if (across) this.across(across);
    const last = this.lines[this.line].length - 1;
    this.number = Math.min(Math.max(this.number + (along ?? 0), 0), last);
    this.show();
  }

  // Another line, in the order of the legend, at the mark next to where this one is.
  across(step) {
    const x = Number(this.mark().dataset.x);
    this.line = (this.line + step + this.lines.length) % this.lines.length;
    const far = this.lines[this.line].map((mark) => Math.abs(mark.dataset.x - x));
    this.number = far.indexOf(Math.min(...far));
  }

  show() {
    const mark = this.mark();
    this.ring.setAttribute("transform", mark.getAttribute("transform"));
    this.svg.append(this.ring);
    if (this.readout.textContent !== mark.dataset.values) this.readout.textContent = mark.dataset.values;
    this.readout.classList.add("shown");
    // Above the mark, or below it where there is no room, and not beyond the sides.
    const scale = this.plot.clientWidth / this.svg.viewBox.baseVal.width;
    const [x, y] = [mark.dataset.x * scale, mark.dataset.y * scale];
    const { offsetWidth: width, offsetHeight: height } = this.readout;
    const left = Math.min(Math.max(x - width / 2, 0), this.plot.clientWidth - width);
    const top = y - height - 14 >= 0 ? y - height - 14 : y + 14;
    this.readout.style.transform = `translate(${left}px, ${top}px)`;
  }

  hide() {
    this.ring.remove();
    this.readout.textContent = "";
    this.readout.classList.remove("shown");
  }
}

for (const plot of document.querySelectorAll(".convergence .plot")) new Values(plot);

const first = document.querySelector(".convergence .panels");
if (first) {
  const hint = document.createElement("p");
  hint.className = "hint";
  hint.textContent = HINT;
  first.after(hint);
}
