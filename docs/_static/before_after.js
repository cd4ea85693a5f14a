// Lays the two pictures of a pair over each other and lets a slider, or the pointer, move the border between them.
// Without this script both pictures stand side by side.
for (const figure of document.querySelectorAll(".before-after")) {
  const pair = figure.querySelector(".pair");
  const slider = document.createElement("input");
  slider.type = "range";
  slider.min = 0;
  slider.max = 100;
  slider.value = 50;
  slider.setAttribute("aria-label", "Where the left picture ends, in percent of the width");
  const show = () => pair.style.setProperty("--border", slider.value + "%");
  slider.addEventListener("input", show);

  const follow = (event) => {
    const box = pair.getBoundingClientRect();
    slider.value = Math.round((100 * (event.clientX - box.left)) / box.width);
    show();
  };
  pair.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    pair.setPointerCapture(event.pointerId);
    follow(event);
  });
  pair.addEventListener("pointermove", (event) => {
    if (pair.hasPointerCapture(event.pointerId)) follow(event);
  });

  figure.classList.add("sliding");
  pair.after(slider);
  show();
}
