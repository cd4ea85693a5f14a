// Shows one picture or drawing of a series at a time, the one that its sliders say, and with it how to render the same.
// Without this script all pictures stand side by side.
for (const figure of document.querySelectorAll("figure.series")) {
  const frames = [...figure.querySelectorAll(".frame")];
  const same = figure.querySelector("[data-same].same");
  const described = JSON.parse(figure.dataset.sliders);

  // Which frame a choice of places is; the last slider changes fastest.
  const frameAt = (places) =>
    frames[places.reduce((number, place, i) => number * described[i].words.length + place, 0)];

  const show = () => {
    const places = sliders.map((slider) => Number(slider.input.value));
    const chosen = frameAt(places);
    for (const frame of frames) frame.hidden = frame !== chosen;
    if (same) same.innerHTML = chosen.dataset.same;
    sliders.forEach((slider, i) => {
      slider.output.textContent = described[i].words[places[i]];
      slider.input.setAttribute("aria-valuetext", described[i].words[places[i]]);
    });
    return places;
  };

  // Pictures are only asked for when they are looked at; from the first touch on, so are those one step away.
  const fetchNeighbours = (places) => {
    places.forEach((place, i) => {
      for (const next of [place - 1, place + 1]) {
        if (next < 0 || next >= described[i].words.length) continue;
        const frame = frameAt(places.map((other, j) => (j === i ? next : other)));
        for (const picture of frame.querySelectorAll("img")) picture.loading = "eager";
      }
    });
  };

  const controls = document.createElement("div");
  controls.className = "controls";
  const sliders = described.map(({ name, start, words }, i) => {
    const row = document.createElement("div");
    const label = document.createElement("label");
    const input = document.createElement("input");
    const output = document.createElement("output");
    row.className = "slider";
    input.type = "range";
    input.id = `${figure.id}-${i}`;
    input.min = 0;
    input.max = words.length - 1;
    input.value = start;
    label.htmlFor = input.id;
    label.textContent = name;
    output.htmlFor = input.id;
    row.append(label, input, output);
    controls.append(row);
    input.addEventListener("input", () => fetchNeighbours(show()));
    for (const touched of ["pointerenter", "pointerdown", "focus"]) {
      input.addEventListener(touched, () => fetchNeighbours(show()), { once: true });
    }
    return { input, output };
  });

  figure.classList.add("sliding");
  figure.querySelector(".frames").after(controls);
  show();
}
