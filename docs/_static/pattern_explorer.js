// Draws sample patterns as readers choose them: the pattern, the domain, how many, again. patterns.js has the points.
// Without this script some patterns stand there as one drawing.
(() => {
  const patterns = penumbra.patterns;

  const PATTERN_NAMES = {
    regular: "regular",
    random: "random",
    jittered: "jittered",
    sobol: "Sobol",
    scrambled: "Sobol, scrambled",
    halton: "Halton",
    hammersley: "Hammersley",
  };
  const DOMAINS = {
    square: { name: "square", where: "in the square" },
    disk: { name: "disk", where: "on the disk", mistake: "uniform radius (a common mistake)" },
    sphere: { name: "sphere", where: "on the sphere", mistake: "uniform angle from the pole (a common mistake)" },
  };
  const CELLS = { none: "none", squares: "squares", wide: "wide", tall: "tall", columns: "columns", rows: "rows" };

  // Every count up to 32, and the powers of two and squares up to 1024.
  const COUNTS = [];
  for (let n = 1; n <= 1024; n++) {
    if (n <= 32 || Number.isInteger(Math.sqrt(n)) || Number.isInteger(Math.log2(n))) COUNTS.push(n);
  }

  const decimals = (value, digits) => value.toFixed(digits);
  const plural = (count, word) => `${count} ${word}${count === 1 ? "" : "s"}`;

  // Columns and rows of the cells that are drawn and counted, no more than there are points.
  function cellsOf(kind, count) {
    const k = Math.floor(Math.sqrt(count));
    const half = Math.max(1, Math.floor(k / 2));
    const shapes = {
      squares: [k, k], wide: [half, 2 * half], tall: [2 * half, half], columns: [count, 1], rows: [1, count],
    };
    return shapes[kind]?.[0] * shapes[kind]?.[1] <= count ? shapes[kind] : shapes[kind] && [1, 1];
  }

  // What is seen, as text, with numbers measured of the very points that are drawn.
  function sentence(state, points) {
    const { x, y } = points;
    const count = x.length;
    const domain = DOMAINS[state.domain];
    const name = PATTERN_NAMES[state.pattern];
    const said = [`${plural(count, "point")} ${domain.where}: ${name}${state.mistaken ? `, ${domain.mistake}` : ""}.`];
    if (count !== state.count) said.push(`A grid takes a square number; the largest up to ${state.count} is ${count}.`);
    if (state.domain === "square") {
      said.push(`The star discrepancy is ${decimals(patterns.starDiscrepancy(points), 3)}.`);
    } else {
      const warp = patterns[state.domain];
      const axis = state.domain === "disk" ? 0 : 2;
      let mean = 0;
      let inner = 0;
      for (let i = 0; i < count; i++) {
        const at = warp(x[i], y[i], state.mistaken);
        mean += at[axis] ** 2 / count;
        if (state.domain === "disk" ? Math.hypot(...at) < 0.5 : Math.abs(at[2]) > Math.sqrt(3) / 2) inner += 1 / count;
      }
      const percent = `${Math.round(100 * inner)}%`;
      said.push(
        state.domain === "disk"
          ? `The mean of x² is ${decimals(mean, 3)}, and should be 0.250. Within half the radius lie ${percent}, and should lie 25%.`
          : `The mean of z² is ${decimals(mean, 3)}, and should be 0.333. Within 30° of the poles lie ${percent}, and should lie 13%.`,
      );
    }
    const cells = cellsOf(state.cells, count);
    if (cells) {
      const [columns, rows] = cells;
      const hit = patterns.cellsHit(points, columns, rows);
      said.push(`Of ${plural(columns * rows, "cell")}, ${columns} by ${rows}, ${hit} ${hit === 1 ? "holds" : "hold"} a point.`);
    }
    return said.join(" ");
  }

  // Places on the domain to places on the canvas: [right, down, towards the viewer], each in [-1, 1].
  function projection(state) {
    if (state.domain === "square") return (u, v) => [2 * u - 1, 2 * v - 1, 1];
    if (state.domain === "disk") {
      return (u, v) => {
        const [x, y] = patterns.disk(u, v, state.mistaken);
        return [x, -y, 1];
      };
    }
    const turn = (state.turn * Math.PI) / 180;
    const tilt = (state.tilt * Math.PI) / 180;
    return (u, v) => {
      const [x, y, z] = patterns.sphere(u, v, state.mistaken);
      const right = x * Math.cos(turn) - y * Math.sin(turn);
      const near = x * Math.sin(turn) + y * Math.cos(turn);
      return [right, near * Math.sin(tilt) - z * Math.cos(tilt), near * Math.cos(tilt) + z * Math.sin(tilt)];
    };
  }

  function draw(canvas, state, points) {
    const size = canvas.clientWidth;
    if (size === 0) return;
    const ratio = window.devicePixelRatio || 1;
    canvas.width = canvas.height = Math.round(size * ratio);
    const style = getComputedStyle(canvas);
    const context = canvas.getContext("2d");
    context.scale(ratio, ratio);
    const count = points.x.length;
    const dot = Math.min(4.5, Math.max(1.3, (0.14 * size) / Math.sqrt(count)));
    const scale = size / 2 - 6;
    const project = projection(state);
    const place = (at) => [size / 2 + scale * at[0], size / 2 + scale * at[1]];

    context.strokeStyle = style.getPropertyValue("--line");
    context.lineWidth = 1;
    context.beginPath();
    if (state.domain === "square") context.rect(size / 2 - scale, size / 2 - scale, 2 * scale, 2 * scale);
    else context.arc(size / 2, size / 2, scale, 0, 2 * Math.PI);
    context.stroke();

    const cells = cellsOf(state.cells, count);
    if (cells) {
      const [columns, rows] = cells;
      // Many lines would hide the points.
      context.globalAlpha = Math.max(columns, rows) > 40 ? 0.35 : 0.8;
      context.beginPath();
      for (let i = 0; i <= columns; i++) line((t) => [i / columns, t]);
      for (let j = 0; j <= rows; j++) line((t) => [t, j / rows]);
      context.stroke();
    }
    function line(at) {
      const steps = state.domain === "square" ? 1 : 64;
      let pen = false;
      for (let s = 0; s <= steps; s++) {
        const projected = project(...at(s / steps));
        const seen = projected[2] >= 0;
        if (seen) context[pen ? "lineTo" : "moveTo"](...place(projected));
        pen = seen;
      }
    }

    context.fillStyle = style.color;
    for (const front of [false, true]) {
      context.globalAlpha = front ? 1 : 0.25;
      context.beginPath();
      for (let i = 0; i < count; i++) {
        const projected = project(points.x[i], points.y[i]);
        if (projected[2] >= 0 !== front) continue;
        const [right, down] = place(projected);
        context.moveTo(right + dot, down);
        context.arc(right, down, dot, 0, 2 * Math.PI);
      }
      context.fill();
    }
  }

  function element(tag, properties = {}, ...children) {
    const made = Object.assign(document.createElement(tag), properties);
    made.append(...children);
    return made;
  }

  function choice(name, options, chosen, changed) {
    const select = element("select");
    for (const [value, text] of Object.entries(options)) select.append(element("option", { value, textContent: text }));
    select.value = chosen;
    select.addEventListener("change", () => changed(select.value));
    return element("label", { className: "choice" }, element("span", { textContent: name }), select);
  }

  function slider(name, id, range, words, changed) {
    const input = element("input", { type: "range", id, ...range });
    const output = element("output");
    output.htmlFor = id;
    const row = element("div", { className: "slider" }, element("label", { htmlFor: id, textContent: name }), input, output);
    const tell = () => {
      output.textContent = words(Number(input.value));
      input.setAttribute("aria-valuetext", output.textContent);
    };
    input.addEventListener("input", () => {
      tell();
      changed(Number(input.value));
    });
    tell();
    return { row, set: (value) => { input.value = value; tell(); } };
  }

  function explore(figure, number) {
    const state = {
      pattern: figure.dataset.pattern, domain: figure.dataset.domain, count: Number(figure.dataset.count),
      cells: figure.dataset.cells, mistaken: false, seed: 1, turn: 30, tilt: 25,
    };
    const id = (name) => `pattern-explorer-${number}-${name}`;
    const canvas = element("canvas");
    const numbers = element("canvas");
    for (const each of [canvas, numbers]) each.setAttribute("role", "img");
    const beside = element("div", { className: "numbers" }, numbers, element("span", { textContent: "before the warp" }));
    const said = element("p", { className: "said" });
    said.setAttribute("aria-live", "polite");

    let points;
    const redraw = () => {
      draw(canvas, state, points);
      if (!beside.hidden) draw(numbers, { ...state, domain: "square" }, points);
    };
    const update = () => {
      points = patterns.PATTERNS[state.pattern].make(state.count, state.seed);
      const flat = state.domain === "square";
      beside.hidden = mistake.hidden = flat;
      turn.row.hidden = tilt.row.hidden = state.domain !== "sphere";
      canvas.classList.toggle("turns", state.domain === "sphere");
      mistakeText.textContent = DOMAINS[state.domain].mistake ?? "";
      again.disabled = !patterns.PATTERNS[state.pattern].chance;
      const mistaken = state.mistaken && !flat;
      said.textContent = sentence({ ...state, mistaken }, points);
      canvas.setAttribute("aria-label", said.textContent);
      numbers.setAttribute("aria-label", "The same points in the unit square, before the warp.");
      redraw();
    };
    const put = (key) => (value) => {
      state[key] = value;
      update();
    };

    const mistakeBox = element("input", { type: "checkbox" });
    mistakeBox.addEventListener("change", () => put("mistaken")(mistakeBox.checked));
    const mistakeText = element("span");
    const mistake = element("label", { className: "mistake" }, mistakeBox, mistakeText);
    const again = element("button", { type: "button", textContent: "Draw again" });
    again.addEventListener("click", () => put("seed")(state.seed + 1));

    const start = COUNTS.findIndex((n) => n >= state.count);
    const count = slider("samples", id("count"), { min: 0, max: COUNTS.length - 1, value: start },
      (place) => `${COUNTS[place]}`, (place) => put("count")(COUNTS[place]));
    const turn = slider("turn", id("turn"), { min: -180, max: 180, step: 5, value: state.turn }, (value) => `${value}°`, put("turn"));
    const tilt = slider("tilt", id("tilt"), { min: -90, max: 90, step: 5, value: state.tilt }, (value) => `${value}°`, put("tilt"));

    // The sphere follows the pointer: a radius' way is about a radian.
    let held;
    canvas.addEventListener("pointerdown", (event) => {
      if (event.button !== 0 || state.domain !== "sphere") return;
      canvas.setPointerCapture(event.pointerId);
      held = { x: event.clientX, y: event.clientY, turn: state.turn, tilt: state.tilt };
    });
    canvas.addEventListener("pointermove", (event) => {
      if (!canvas.hasPointerCapture(event.pointerId)) return;
      const degrees = 115 / canvas.clientWidth;
      const round = held.turn - degrees * (event.clientX - held.x);
      state.turn = Math.round(((((round + 180) % 360) + 360) % 360) - 180);
      state.tilt = Math.round(Math.max(-90, Math.min(90, held.tilt + degrees * (event.clientY - held.y))));
      turn.set(state.turn);
      tilt.set(state.tilt);
      redraw();
    });

    const domainNames = Object.fromEntries(Object.entries(DOMAINS).map(([key, { name }]) => [key, name]));
    figure.querySelector(".still").after(
      element("div", { className: "stage" }, canvas, beside),
      said,
      element("div", { className: "choices" },
        choice("pattern", PATTERN_NAMES, state.pattern, put("pattern")),
        choice("domain", domainNames, state.domain, put("domain")),
        choice("cells", CELLS, state.cells, put("cells")),
        again),
      mistake, count.row, turn.row, tilt.row);
    figure.classList.add("live");
    update();

    new ResizeObserver(redraw).observe(canvas);
    new MutationObserver(redraw).observe(document.body, { attributes: true, attributeFilter: ["data-theme"] });
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
  }

  document.querySelectorAll("figure.pattern-explorer").forEach(explore);
})();
