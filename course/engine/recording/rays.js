// A view of recorded rays in their scene, drawn on a canvas: penumbra.rays(element, data). The data are those of
// course/engine/recording/view.py; with data.right the rays of the right functions are shown as well. Triangles and pieces of
// rays are drawn from the farthest to the nearest.
"use strict";
var penumbra = window.penumbra || {};

penumbra.rays = function (root, data) {
  const SAMPLE = 0, PARENT = 1, DEPTH = 2, KIND = 3, START = 4, END = 5, MET = 6, AIM = 7, LIGHT = 8, CALLS = 9, WHO = 10;
  const YOURS = 0, RIGHT = 1;
  const PIECES = 10;
  const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
  const mix = (a, b, t) => [a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t, a[2] + (b[2] - a[2]) * t];
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const unit = (a) => { const n = Math.hypot(...a) || 1; return [a[0] / n, a[1] / n, a[2] / n]; };

  // ---- what there is
  const sides = data.right ? [data, data.right] : [data];
  const segments = sides.flatMap((side, who) => side.segments.map((each) => [...each, who]));
  const samples = data.samples;
  const nameOf = (each) => sides[each[WHO]].names[each[MET]];
  const into = (each) => nameOf(each) === "environment";
  const deepest = Math.max(0, ...segments.map((each) => each[DEPTH]));
  const counted = (kind, who) => segments.filter((each) => each[KIND] === kind && each[WHO] === who).length;
  // Wrong rays may end anywhere: the right ones say how large the view is. Where these hit nothing, the wrong ones do,
  // or the places of the objects, by their middles: a floor may be very large.
  const hitting = segments.filter((each) => !into(each));
  const righter = hitting.filter((each) => each[WHO] === sides.length - 1);
  const sized = righter.length ? righter : hitting;
  const middle = (points) => [0, 1, 2].map((k) => (Math.min(...points.map((p) => p[k])) + Math.max(...points.map((p) => p[k]))) / 2);
  const there = [...data.objects.map((object) => middle(object.triangles.flatMap((t) => [t.slice(0, 3), t.slice(3, 6), t.slice(6, 9)]))), ...data.camera.film];
  const places = sized.length ? sized.map((each) => each[END]) : there;
  const focus = mix(places.reduce((a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]]).map((x) => x / places.length), data.camera.eye, 0.25);
  const far = [...places, data.camera.eye].map((p) => Math.hypot(...sub(p, focus))).sort((a, b) => a - b);
  const extent = Math.max(far[far.length - 1], 1e-9);
  const spans = (points) => [0, 1, 2].map((k) => {
    const values = points.map((p) => p[k]);
    return values.length ? Math.max(...values) - Math.min(...values) : 0;
  });
  const reach = Math.max(...spans(places));
  // On which side of a triangle all rays end: 1 where its normal points, -1 behind it, 0 on both sides.
  const side = (corner, normal) => {
    const heights = places.map((p) => dot(normal, sub(p, corner))), least = 1e-3 * extent;
    return heights.every((h) => h > -least) ? 1 : heights.every((h) => h < least) ? -1 : 0;
  };
  const triangles = [], BEHIND = 1e6 * extent;
  for (const object of data.objects) {
    const wide = Math.max(...spans(object.triangles.flatMap((t) => [t.slice(0, 3), t.slice(3, 6), t.slice(6)]))) > 0.7 * reach;
    for (const t of object.triangles) {
      const corners = [t.slice(0, 3), t.slice(3, 6), t.slice(6, 9)];
      const normal = unit(cross(sub(corners[1], corners[0]), sub(corners[2], corners[0])));
      const longest = Math.max(...corners.map((corner, k) => Math.hypot(...sub(corner, corners[(k + 1) % 3]))));
      triangles.push({ corners, normal, longest, side: wide ? side(corners[0], normal) : 0, color: object.color, lamp: object.lamp });
    }
  }

  // ---- the view: an orbit around the focus
  const upward = data.camera.up.map(Math.abs);
  const axis = upward.indexOf(Math.max(...upward));
  const up = [0, 0, 0];
  up[axis] = Math.sign(data.camera.up[axis]);
  const east = unit(cross(up, Math.abs(up[0]) > 0.5 ? [0, 0, 1] : [1, 0, 0]));
  const north = cross(up, east);
  const first = unit(sub(data.camera.eye, focus));
  const turned = { turn: Math.atan2(dot(first, north), dot(first, east)) + 0.75, tilt: 0.4 };
  const shown = { kinds: data.kinds.map(() => true), depth: deepest, surfaces: 1, sample: -1, who: -1 };
  // What can be looked at from near: a lamp or the lens by its size, and where the camera's rays end.
  const near = [["all", focus, 2.6 * extent]];
  const firsts = sized.filter((each) => each[DEPTH] === 0 && each[KIND] === 0).map((each) => each[END]);
  const home = { ...turned, distance: 2.6 * extent, focus };
  if (firsts.length) {
    const hit = firsts[Math.floor(firsts.length / 2)];
    near.push(["what is hit", hit, 0.5 * extent]);
    // The first view is of the pixel's neighbourhood: a far lamp, or rays that fly on over a plain, would leave it small.
    const close = 1.9 * Math.hypot(...sub(hit, data.camera.eye));
    if (close < home.distance) Object.assign(home, { focus: mix(hit, data.camera.eye, 0.25), distance: close });
    near.unshift(["the pixel", home.focus, home.distance]);
  }
  const view = { ...home };
  for (const lamp of data.lamps) {
    if (lamp.radius) near.push([lamp.name, lamp.at, 5 * lamp.radius]);
    else if (lamp.around) near.push([lamp.name, mix(lamp.around[0], lamp.around[2], 0.5), 2.2 * Math.hypot(...sub(lamp.around[0], lamp.around[2]))]);
  }
  if (data.camera.lens) near.push(["lens", data.camera.eye, 6 * data.camera.lens]);

  // ---- elements
  const make = (name, attributes, ...children) => {
    const element = document.createElement(name);
    for (const [key, value] of Object.entries(attributes || {})) {
      if (key.startsWith("on")) element.addEventListener(key.slice(2), value);
      else element.setAttribute(key, value);
    }
    element.append(...children);
    return element;
  };
  const style = getComputedStyle(root);
  const color = (name) => style.getPropertyValue(`--${name}`).trim();
  const canvas = make("canvas", {
    tabindex: "0", role: "img",
    "aria-label": "The scene with the recorded rays. Arrow keys orbit, plus and minus zoom, comma and full stop choose a sample.",
  });
  const boxes = make("fieldset", {}, make("legend", {}, "Rays"));
  if (data.right) {
    [["both", -1], ["yours", YOURS], ["the right ones", RIGHT]].forEach(([name, who]) => {
      const button = make("input", { type: "radio", name: `who-${penumbra.views = (penumbra.views || 0) + 1}`, "data-who": who, onchange: () => { shown.who = who; draw(); } });
      const swatch = who === RIGHT ? [make("i", { style: "background: var(--right)" })] : [];
      boxes.append(make("label", {}, button, ...swatch, name));
    });
    const [one, ...rest] = boxes.querySelectorAll("input[type=radio]");
    rest.forEach((each) => { each.name = one.name; });
    one.checked = true;
  }
  data.kinds.forEach((kind, number) => {
    const counts = sides.map((_, who) => counted(number, who));
    if (!Math.max(...counts)) return;
    const box = make("input", { type: "checkbox", checked: "", "data-kind": kind, onchange: () => { shown.kinds[number] = box.checked; draw(); } });
    const swatch = make("i", { style: `background: var(--${kind})` });
    boxes.append(make("label", {}, box, swatch, `${kind} (${counts.join(", right: ")})`));
  });
  if (segments.some((each) => each[AIM])) {
    boxes.append(make("label", {}, make("i", { style: "background: var(--behind)" }), "black: behind a blocker"));
  }
  const slider = (name, min, max, step, value, change) => {
    const output = make("output", {});
    const input = make("input", { type: "range", min, max, step, value, oninput: () => { output.textContent = change(Number(input.value)); draw(); } });
    const label = make("label", { class: "slider" }, make("span", { class: "name" }, name, " "), output, input);
    output.textContent = change(value);
    return { label, input, output };
  };
  const depth = slider("Bounces shown:", 0, deepest, 1, deepest, (value) => { shown.depth = value; return `up to ${value}`; });
  const surfaces = slider("Surfaces:", 0, 1, 0.05, shown.surfaces, (value) => { shown.surfaces = value; return `${Math.round(100 * value)} %`; });
  const told = make("div", { class: "told", "aria-live": "polite", tabindex: "0", role: "region", "aria-label": "The chosen sample" });
  const svg = drawn("svg", { viewBox: "-0.02 -0.02 1.04 1.04", "aria-hidden": "true" });
  const brightest = Math.max(...samples.map((each) => Math.max(...each.radiance.map(Number))), 1e-9);
  const weights = samples.map((each) => Number(each.weight));
  const heaviest = Math.max(...weights), lightest = Math.min(...weights);
  const dots = samples.map((each, number) => {
    const dot = drawn("circle", { class: "sample" });
    const shade = each.radiance.map((x) => Math.round(255 * Math.min(1, Math.max(0, Number(x) / brightest)) ** (1 / 2.2)));
    dot.setAttribute("cx", each.offset[0]);
    dot.setAttribute("cy", each.offset[1]);
    // A dot's area is its sample's weight.
    dot.setAttribute("r", (samples.length > 80 ? 0.016 : 0.024) * (heaviest > lightest ? Math.max(0.3, 1.3 * Math.sqrt(Math.abs(Number(each.weight)) / heaviest)) : 1));
    dot.setAttribute("fill", `rgb(${shade})`);
    dot.addEventListener("click", () => pick(number));
    svg.append(dot);
    return dot;
  });
  // Where the right function puts its samples elsewhere.
  (data.right ? data.right.samples : []).forEach((each, number) => {
    if (!samples[number] || Math.hypot(each.offset[0] - samples[number].offset[0], each.offset[1] - samples[number].offset[1]) < 1e-3) return;
    svg.append(drawn("circle", { class: "right", cx: each.offset[0], cy: each.offset[1], r: 0.02 }));
  });
  const results = strips();
  const chooser = slider("Sample:", 0, samples.length, 1, 0, (value) => { choose(value - 1); return value ? `number ${samples[value - 1].number}` : "all"; });
  const pick = (number) => {
    chooser.input.value = number + 1;
    chooser.input.dispatchEvent(new Event("input"));
  };
  const reset = make("button", { type: "button", onclick: () => { Object.assign(view, home); looking.value = "0"; draw(); } }, "Reset view");
  const looking = make("select", { onchange: () => { [, view.focus, view.distance] = near[looking.value]; draw(); } }, ...near.map(([name], number) => make("option", { value: number }, name)));
  const look = make("label", { class: "slider" }, make("span", { class: "name" }, "Look at: "), looking);
  const all = make("button", { type: "button", onclick: () => pick(-1) }, "All samples");
  const pattern = make("fieldset", {}, make("legend", {}, "Samples in the pixel"), svg, chooser.label, all);
  const help = make("p", { class: "help" }, "Drag or use the arrow keys to orbit, pinch or + and − to zoom, and click a ray or a dot to choose a sample.");
  if (samples.length < data.all) help.append(` ${samples.length} of ${data.all} samples are shown.`);
  if (data.right) help.append(" Both had the same numbers, but which number turns which way is free: compare all rays before single ones.");
  root.append(make("div", { class: "main" }, canvas, help, told, ...results.map((each) => each.element)), make("div", { class: "side" }, boxes, make("fieldset", {}, make("legend", {}, "View"), ...(near.length > 1 ? [look] : []), ...(deepest ? [depth.label] : []), surfaces.label, reset), pattern));

  // What functions returned: a row of ticks for each coordinate, yours above the right ones.
  function strips() {
    const found = new Map();
    for (const each of segments) {
      for (const [number, ...returned] of each[CALLS]) {
        returned.forEach((result, which) => {
          const values = (Array.isArray(result) ? result : [result]).map(Number);
          const name = sides[each[WHO]].functions[number] + " returned" + called(sides[each[WHO]], number, which, " as ");
          if (values.length > 4 || values.some((x) => Number.isNaN(x))) return;
          if (!found.has(name)) found.set(name, []);
          found.get(name).push([each[WHO], each[SAMPLE], values]);
        });
      }
    }
    // The filter's weight is a result, too, though nobody is asked for single rays.
    const weighed = sides.flatMap((side, who) => side.samples.map((each, sample) => [who, sample, [Math.hypot(each.offset[0] - 0.5, each.offset[1] - 0.5), Number(each.weight)]]));
    if (weighed.some(([, , [, weight]]) => weight !== weighed[0][2][1])) found.set("the filter returned", weighed);
    return [...found].slice(0, 8).map(([name, calls]) => {
      const box = make("fieldset", { class: "results" }, make("legend", {}, `What ${name}`));
      const ticks = [];
      const axes = name === "the filter returned" ? ["distance from the pixel's centre", "weight"] : ["x", "y", "z", "w"];
      const across = Math.max(...calls.map(([, , values]) => values.length));
      for (let axis = 0; axis < across; axis += 1) {
        const all = calls.filter(([, , values]) => axis < values.length && Number.isFinite(values[axis]));
        if (!all.length) continue;
        const low = Math.min(...all.map(([, , values]) => values[axis])), high = Math.max(...all.map(([, , values]) => values[axis]));
        const at = (x) => (high > low ? (x - low) / (high - low) : 0.5);
        const said = sides.map((_, who) => {
          const own = all.filter(([whose]) => whose === who).map(([, , values]) => values[axis]);
          if (!own.length) return "none";
          return `${sides.length > 1 ? (who ? "right: " : "yours: ") : ""}${round(Math.min(...own))} to ${round(Math.max(...own))}, mean ${round(own.reduce((a, b) => a + b) / own.length)}`;
        });
        const label = across > 1 ? axes[axis] : "value";
        const strip = drawn("svg", { viewBox: `0 0 400 ${14 * sides.length}`, role: "img", "aria-label": `${name}, ${label}: ${said.join("; ")}` });
        for (const [who, sample, values] of all) {
          const x = 4 + 392 * at(values[axis]);
          const tick = drawn("line", { x1: x, x2: x, y1: 14 * who + 2, y2: 14 * who + 12, class: who ? "right" : "yours" });
          ticks.push([sample, tick]);
          strip.append(tick);
        }
        box.append(make("p", {}, make("b", {}, label), ` ${said.join("; ")}`), strip);
      }
      const planes = make("div", { class: "planes" });
      for (const [a, b] of across === 2 ? [[0, 1]] : across === 3 ? [[0, 1], [0, 2], [1, 2]] : []) {
        const points = calls.map(([who, sample, values]) => [who, sample, values[a], values[b]]).filter(([, , x, y]) => Number.isFinite(x) && Number.isFinite(y));
        const spans = [2, 3].map((k) => [Math.min(...points.map((p) => p[k])), Math.max(...points.map((p) => p[k]))]);
        const size = Math.max(...spans.map(([low, high]) => high - low)) || 1;
        const place = (x, k) => 50 + 92 * (x - (spans[k][0] + spans[k][1]) / 2) / size;
        const plane = drawn("svg", { viewBox: "0 0 100 100", role: "img", "aria-label": `${name}: ${axes[b]} over ${axes[a]}` });
        for (const [who, sample, x, y] of points) {
          const mark = drawn("circle", { cx: place(x, 0), cy: 100 - place(y, 1), r: who ? 1.6 : 1.3, class: who ? "plot right" : "plot yours" });
          ticks.push([sample, mark]);
          plane.append(mark);
        }
        planes.append(make("figure", {}, plane, make("figcaption", {}, `${axes[b]} over ${axes[a]}`)));
      }
      if (planes.children.length) box.append(planes);
      return { element: box, ticks };
    });
  }

  // A result by its name, where a function has several.
  function called(side, number, which, before) {
    const names = side.results[number];
    return names.length > 1 ? before + names[which] : "";
  }

  function drawn(name, attributes) {
    const element = document.createElementNS("http://www.w3.org/2000/svg", name);
    Object.entries(attributes).forEach(([key, value]) => element.setAttribute(key, value));
    return element;
  }

  function round(x) {
    return Number(x.toPrecision(3));
  }

  function choose(number) {
    shown.sample = number;
    dots.forEach((dot, each) => dot.classList.toggle("chosen", each === number));
    results.forEach(({ ticks }) => ticks.forEach(([sample, tick]) => tick.classList.toggle("chosen", sample === number)));
    told.replaceChildren();
    if (number < 0) return;
    sides.forEach((side, who) => {
      const list = make("ol", {});
      for (const each of segments.filter((one) => one[SAMPLE] === number && one[WHO] === who)) {
        const calls = each[CALLS].map(([name, ...returned]) => ` ${side.functions[name]} returned ${returned.map((result, which) => `${called(side, name, which, "")} ${Array.isArray(result) ? `(${result.join(", ")})` : result}`.trim()).join(", ")}.`);
        const brought = each[LIGHT] ? `, brings ${each[LIGHT]}` : "";
        const met = each[AIM] ? `is blocked by ${nameOf(each)}` : `meets ${nameOf(each)}`;
        list.append(make("li", {}, `${data.kinds[each[KIND]]} ray ${met}${brought}.${calls.join("")}`));
      }
      const one = side.samples[number];
      const share = one ? `Sample ${one.number}: ${Math.round(1000 * one.share) / 10} % of the pixel's light.` : "";
      told.append(make("p", {}, `${sides.length > 1 ? (who ? "Right. " : "Yours. ") : ""}${share}`), list);
    });
  }

  // ---- drawing
  let projected = [];
  let waiting = false;
  function draw() {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => { waiting = false; paint(); });
  }

  function paint() {
    const ratio = window.devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight;
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
    }
    const pen = canvas.getContext("2d");
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, width, height);
    pen.lineCap = "round";
    const flat = Math.cos(view.tilt);
    const out = [0, 1, 2].map((k) => flat * (Math.cos(view.turn) * east[k] + Math.sin(view.turn) * north[k]) + Math.sin(view.tilt) * up[k]);
    const eye = view.focus.map((x, k) => x + out[k] * view.distance);
    const right = unit(cross(up, out)), above = cross(out, right);
    const scale = 1.5 * Math.min(width, height), nearest = 0.02 * view.distance;
    const seen = (p) => {
      const d = sub(p, eye), z = -dot(d, out);
      return z < nearest ? null : [width / 2 + scale * dot(d, right) / z, height / 2 - scale * dot(d, above) / z, z];
    };
    const items = [];

    for (const t of triangles) {
      const p = t.corners.map(seen);
      if (p.some((each) => each === null)) continue;
      // The near walls of a room would hide what is in it. The far ones and the floor are behind all else: they come
      // first, the longest before those that lie on them.
      const facing = t.side * dot(t.normal, sub(eye, t.corners[0])), fades = facing < 0;
      const z = facing > 0 ? BEHIND + t.longest : (p[0][2] + p[1][2] + p[2][2]) / 3;
      const alpha = shown.surfaces * (fades ? 0.12 : 1);
      if (alpha < 0.01) continue;
      const shade = t.lamp ? 1 : 0.45 + 0.55 * Math.abs(dot(t.normal, unit(sub(eye, t.corners[0]))));
      items.push([z, () => {
        pen.globalAlpha = alpha;
        pen.fillStyle = pen.strokeStyle = `rgb(${t.color.map((c) => Math.round(c * shade))})`;
        pen.beginPath();
        pen.moveTo(p[0][0], p[0][1]);
        pen.lineTo(p[1][0], p[1][1]);
        pen.lineTo(p[2][0], p[2][1]);
        pen.closePath();
        pen.fill();
        // Neighbours' antialiased edges would leave a gap.
        if (alpha === 1) { pen.lineWidth = 0.7; pen.stroke(); }
      }]);
    }
    const line = (a, b, ink, thickness, alpha, dash, pieces) => {
      for (let k = 0; k < pieces; k += 1) {
        const p = seen(mix(a, b, k / pieces)), q = seen(mix(a, b, (k + 1) / pieces));
        if (!p || !q) continue;
        // A little nearer than it is, so that a ray isn't hidden by the surface that it ends on.
        items.push([Math.min(p[2], q[2]) - 0.02 * extent, () => {
          pen.globalAlpha = alpha;
          pen.strokeStyle = ink;
          pen.lineWidth = thickness;
          pen.setLineDash(dash);
          pen.beginPath();
          pen.moveTo(p[0], p[1]);
          pen.lineTo(q[0], q[1]);
          pen.stroke();
          pen.setLineDash([]);
        }]);
      }
    };
    const dotAt = (place, ink, radius, alpha) => {
      const p = seen(place);
      if (!p) return;
      items.push([p[2] - 0.03 * extent, () => {
        pen.globalAlpha = alpha;
        pen.fillStyle = ink;
        pen.beginPath();
        pen.arc(p[0], p[1], radius, 0, 7);
        pen.fill();
      }]);
    };
    projected = [];
    segments.forEach((each, number) => {
      const some = shown.sample >= 0, mine = each[SAMPLE] === shown.sample;
      if (!shown.kinds[each[KIND]] || each[DEPTH] > shown.depth || (shown.who >= 0 && each[WHO] !== shown.who)) return;
      // Beside yours the right ones have one colour; by themselves they have those of their kinds.
      const right = each[WHO] === RIGHT && shown.who < 0;
      const ink = color(right ? "right" : data.kinds[each[KIND]]), dash = right ? [5, 4] : [];
      const alpha = some ? (mine ? 1 : 0.1) : Math.max(0.25, Math.min(0.9, 12 / samples.length)) * (right ? 0.7 : 1);
      const thickness = mine ? 3 : 1.4;
      // Rays into the distance are drawn as long as the scene is wide.
      const length = Math.hypot(...sub(each[END], each[START]));
      const end = into(each) && length > extent ? mix(each[START], each[END], extent / length) : each[END];
      line(each[START], end, ink, thickness, alpha, dash, PIECES);
      if (each[AIM]) {
        const way = Math.hypot(...sub(each[AIM], end));
        line(end, way > 2 * extent ? mix(end, each[AIM], 2 * extent / way) : each[AIM], color("behind"), thickness, some && !mine ? 0.1 : Math.min(1, alpha * 1.3), [], PIECES);
      }
      const p = seen(each[START]), q = seen(end);
      if (p && q) projected.push([number, p, q]);
      // Where it aims at the lamp, and where it leaves the lens.
      const marks = data.kinds[each[KIND]] === "shadow" ? [each[AIM] || each[END]] : data.camera.lens && each[PARENT] < 0 ? [each[START]] : [];
      marks.forEach((mark) => dotAt(mark, ink, mine ? 5 : right ? 2 : 2.6, some && !mine ? 0.25 : 0.9));
    });
    const outline = (corners, ink, thickness, alpha) => corners.forEach((corner, k) => line(corner, corners[(k + 1) % corners.length], ink, thickness, alpha, [], 1));
    const circle = (center, radius, u, v, ink, thickness) => {
      const around = Array.from({ length: 24 }, (_, k) => center.map((x, c) => x + radius * (Math.cos(k * Math.PI / 12) * u[c] + Math.sin(k * Math.PI / 12) * v[c])));
      outline(around, ink, thickness, 1);
    };
    const { camera } = data;
    outline(camera.film, color("film"), 1.2, 1);
    camera.film.forEach((corner) => line(camera.eye, corner, color("film"), 1, 0.5, [], 1));
    outline(camera.pixel, color("bounce"), 3, 1);
    if (camera.lens) circle(camera.eye, camera.lens, camera.right, camera.up, color("film"), 1.5);
    for (const lamp of data.lamps) {
      if (lamp.around) outline(lamp.around, color("shadow"), 2, 1);
      else if (lamp.radius) {
        circle(lamp.at, lamp.radius, right, above, color("shadow"), 2);
        circle(lamp.at, lamp.radius, east, north, color("shadow"), 1);
      }
    }
    items.sort((a, b) => b[0] - a[0]).forEach(([, paintOne]) => paintOne());
    // What surfaces hide of the rays shines through them faintly.
    pen.setLineDash([2, 5]);
    for (const [number, p, q] of projected) {
      const each = segments[number];
      if (shown.sample >= 0 ? each[SAMPLE] !== shown.sample : samples.length > 1) continue;
      pen.globalAlpha = 0.6;
      pen.strokeStyle = color(data.kinds[each[KIND]]);
      pen.lineWidth = 1.5;
      pen.beginPath();
      pen.moveTo(p[0], p[1]);
      pen.lineTo(q[0], q[1]);
      pen.stroke();
    }
    pen.setLineDash([]);
    pen.globalAlpha = 1;
    pen.font = "14px system-ui, sans-serif";
    const label = (place, text) => {
      const p = seen(place);
      if (!p) return;
      pen.lineWidth = 4;
      pen.strokeStyle = color("sky");
      pen.fillStyle = color("ink");
      pen.strokeText(text, p[0] + 8, p[1] - 8);
      pen.fillText(text, p[0] + 8, p[1] - 8);
    };
    label(camera.eye, "camera");
    // Names of a thousand lamps would hide them.
    const few = data.lamps.length <= 12;
    for (const lamp of data.lamps) {
      const at = lamp.around ? mix(lamp.around[0], lamp.around[2], 0.5) : lamp.at;
      const p = seen(at);
      if (p && !lamp.around && !lamp.radius) {
        pen.fillStyle = color("shadow");
        pen.beginPath();
        pen.arc(p[0], p[1], few ? 5 : 1.5, 0, 7);
        pen.fill();
      }
      if (few) label(at, lamp.name);
    }
  }

  // ---- hands
  const held = new Map();
  let moved = 0, apart = 0;
  canvas.addEventListener("pointerdown", (event) => {
    held.set(event.pointerId, [event.clientX, event.clientY]);
    canvas.setPointerCapture(event.pointerId);
    moved = apart = 0;
  });
  canvas.addEventListener("pointermove", (event) => {
    const before = held.get(event.pointerId);
    if (!before) return;
    const now = [event.clientX, event.clientY];
    held.set(event.pointerId, now);
    if (held.size === 2) {
      const [a, b] = [...held.values()], wide = Math.hypot(a[0] - b[0], a[1] - b[1]);
      if (apart) zoom(apart / wide);
      apart = wide;
      return;
    }
    moved += Math.abs(now[0] - before[0]) + Math.abs(now[1] - before[1]);
    orbit((before[0] - now[0]) * 0.008, (now[1] - before[1]) * 0.008);
  });
  const release = (event) => {
    if (held.delete(event.pointerId) && event.type === "pointerup" && moved < 4 && !apart) pickAt(event.offsetX, event.offsetY);
  };
  canvas.addEventListener("pointerup", release);
  canvas.addEventListener("pointercancel", release);
  canvas.addEventListener("wheel", (event) => {
    if (document.activeElement !== canvas) return;
    event.preventDefault();
    zoom(Math.exp(event.deltaY * 0.001));
  }, { passive: false });
  canvas.addEventListener("keydown", (event) => {
    const step = 0.08;
    const does = {
      ArrowLeft: () => orbit(-step, 0), ArrowRight: () => orbit(step, 0),
      ArrowUp: () => orbit(0, step), ArrowDown: () => orbit(0, -step),
      "+": () => zoom(0.9), "=": () => zoom(0.9), "-": () => zoom(1 / 0.9),
      ",": () => pick(Math.max(-1, shown.sample - 1)), ".": () => pick(Math.min(samples.length - 1, shown.sample + 1)),
      Escape: () => pick(-1), Home: () => reset.click(),
    }[event.key];
    if (!does || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    does();
  });

  function orbit(turn, tilt) {
    view.turn += turn;
    view.tilt = Math.max(-1.5, Math.min(1.5, view.tilt + tilt));
    draw();
  }

  function zoom(by) {
    view.distance = Math.max(0.1 * extent, Math.min(20 * extent, view.distance * by));
    draw();
  }

  function pickAt(x, y) {
    let best = 10, found = -1;
    for (const [number, p, q] of projected) {
      const [dx, dy] = [q[0] - p[0], q[1] - p[1]];
      const t = Math.max(0, Math.min(1, ((x - p[0]) * dx + (y - p[1]) * dy) / (dx * dx + dy * dy || 1)));
      const distance = Math.hypot(p[0] + t * dx - x, p[1] + t * dy - y);
      if (distance < best) [best, found] = [distance, segments[number][SAMPLE]];
    }
    pick(found);
  }

  // With the right rays beside yours, the one that is farthest off is marked.
  if (data.marked === undefined) choose(-1);
  else pick(data.marked);
  new ResizeObserver(draw).observe(canvas);
  window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", draw);
  draw();
  return { view, shown, draw, pick };
};

// A view begins once it is near the window.
penumbra.start = new IntersectionObserver((entries) => {
  for (const { isIntersecting, target } of entries) {
    if (!isIntersecting) continue;
    penumbra.start.unobserve(target);
    penumbra.rays(target, JSON.parse(target.querySelector("script").textContent));
  }
}, { rootMargin: "400px" });
document.querySelectorAll(".rays").forEach((each) => { if (each.querySelector("script")) penumbra.start.observe(each); });
