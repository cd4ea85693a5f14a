// The page of the studio: it shows what the server tells (course/school/studio/server.py), and tells it what is wished.
"use strict";
(() => {
  const token = document.body.dataset.token, viewing = document.body.dataset.mode === "view";
  const $ = (id) => document.getElementById(id);
  const make = (name, attributes, ...children) => {
    const element = document.createElement(name);
    for (const [key, value] of Object.entries(attributes || {})) element.setAttribute(key, value);
    element.append(...children);
    return element;
  };
  const put = (id, text) => { if ($(id).textContent !== text) $(id).textContent = text; };
  const AWAY = "The studio doesn't answer: it has ended, or this machine slept. The page goes on when it answers; a studio that was started anew has an address of its own, which it prints.";
  const ask = async (wish, told = {}) => {
    try {
      return await fetch(`/${wish}`, {
        method: "POST", headers: { "X-Token": token, "Content-Type": "application/json" }, body: JSON.stringify(told),
      });
    } catch {
      put("status", AWAY);
      return null;
    }
  };
  const main = viewing ? "course" : "mine";
  let state = null, size = [3, 2];

  // ---- pictures: raw pixels, one request at a time, the newest last
  const loading = {}, shown = {};
  async function load(name, canvas, key) {
    if (shown[name] === key) return;
    if (loading[name]) { loading[name] = key; return; }
    loading[name] = key;
    try {
      const answer = await fetch(`/picture/${name}`, { headers: { "X-Token": token } });
      if (answer.status === 200) {
        const [width, height] = answer.headers.get("X-Size").split("x").map(Number);
        draw(canvas, width, height, new Uint8ClampedArray(await answer.arrayBuffer()));
        shown[name] = key;
      } else if (name === "change" || name === "difference") {
        canvas.getContext("2d").clearRect(0, 0, canvas.width, canvas.height);
        shown[name] = key;
      }
    } catch {
      // Whatever is told next asks for it again.
    } finally {
      const next = loading[name];
      loading[name] = null;
      if (next !== key) load(name, canvas, next);
    }
  }
  const scratch = document.createElement("canvas"), kept = document.createElement("canvas");
  function draw(canvas, width, height, pixels) {
    if (canvas.width !== width || canvas.height !== height) {
      // A picture of another size, such as the small ones that follow a view, stays until there is more.
      kept.width = canvas.width;
      kept.height = canvas.height;
      kept.getContext("2d").drawImage(canvas, 0, 0);
      canvas.width = width;
      canvas.height = height;
      canvas.style.aspectRatio = `${size[0]} / ${size[1]}`;
      canvas.getContext("2d").drawImage(kept, 0, 0, width, height);
    }
    scratch.width = width;
    scratch.height = height;
    scratch.getContext("2d").putImageData(new ImageData(pixels, width, height), 0, 0);
    // Where there is no sample yet, the picture before stays.
    canvas.getContext("2d").drawImage(scratch, 0, 0);
    canvas.dataset.drawn = Number(canvas.dataset.drawn || 0) + 1;
  }

  // ---- what the studio tells
  const samples = (n) => (n === 1 ? "1 sample a pixel" : `${n} samples a pixel`);
  const FEW = 16;
  function caption(name, side) {
    if (side.small) return "follows the view: a small picture, 1 sample a pixel, grainy";
    if (side.old) return side.trouble ? "the picture before" : "the picture before; the new one is being made";
    if (!side.samples) return side.rendering ? "being made" : "";
    const far = side.samples < side.most && !side.trouble;
    const so = far ? ` so far, ${side.most} to come` : "";
    return `${samples(side.samples)}${so}, ${side.seconds.toFixed(1)} s${side.samples < FEW && far ? ": still grainy" : ""}`;
  }
  function show(told) {
    state = told;
    size = told.size;
    $("x").max = size[0] - 1;
    $("y").max = size[1] - 1;
    put("title", told.title === told.file ? told.file : `${told.title} (${told.file})`);
    for (const [name, side] of Object.entries(told.sides)) {
      load(name, $(name), `${side.job} ${side.version}`);
      put(`${name}-told`, caption(name, side));
      $(name).classList.toggle("old", Boolean(side.trouble) || side.old);
      const lines = [side.trouble, side.note];
      if (side.printed && (side.trouble || side.note || name === "mine")) lines.push(`printed:\n${side.printed.slice(0, 600)}`);
      const text = lines.filter(Boolean).join("\n\n");
      put(`${name}-trouble`, text);
      $(`${name}-trouble`).hidden = !text;
      $(`${name}-trouble`).classList.toggle("note", !side.trouble);
    }
    const mine = told.sides.mine;
    const doing = Object.entries(told.sides).filter(([, side]) => side.rendering).map(([name]) => (name === "mine" ? "your picture" : viewing ? "the picture" : "the reference"));
    put("status", told.own ? `The studio failed at something, and goes on: ${told.own}` : told.trouble ? `The scene has a mistake: ${told.trouble}` : doing.length ? `rendering ${doing.join(" and ")}` : "ready");
    document.body.dataset.state = doing.length ? "rendering" : "ready";
    if (mine) {
      const key = $("which").value, known = (key === "change" ? told.changed : told.differing) !== null;
      $("difference").classList.toggle("old", !known);
      if (known) load(key, $("difference"), `${key} ${mine.job} ${mine.version} ${told.sides.course.version}`);
      verdict(told);
      curve(told);
    }
    sliders(told);
    $("reset").disabled = !told.moved;
    if (told.sides[main].shown >= awaited) pending = false;
    flush();
  }

  function verdict(told) {
    const change = $("which").value === "change", share = change ? told.changed : told.differing;
    const mine = told.sides.mine, many = change ? samples(mine.samples) : `${told.compared[0]} and ${told.compared[1]} samples a pixel`;
    const both = change ? "your picture now and before the last save" : `your picture and the reference, of ${many}`;
    if (share === null) put("verdict", change && !told.saved ? "Nothing was saved yet." : mine.trouble || (!change && told.sides.course.trouble) ? "There is nothing to compare: one of the pictures isn't there." : `Being made: it compares ${change ? both : "your picture with the reference of the same view"}.`);
    else if (share < 0.0005) put("verdict", `No difference between ${both} but noise.`);
    else put("verdict", `${(100 * share).toFixed(share < 0.1 ? 1 : 0)} % of the pixels differ by more than noise between ${both}${told.sides.course.rendering && !change ? ", so far" : ""}.`);
  }

  function curve(told) {
    const box = $("curve"), width = 360, height = 240, left = 46, low = 200, top = 14, right = 346;
    const lines = [["before", told.curve_before], ["now", told.curve]].map(([name, points]) => [name, points.filter((p) => p[0] > 0 && p[2] > 0)]);
    const all = lines.flatMap(([, points]) => points);
    const key = JSON.stringify([lines, told.sides.course.samples]);
    if (box.dataset.key === key) return;
    box.dataset.key = key;
    box.replaceChildren();
    const svg = (name, attributes, text) => {
      const element = document.createElementNS("http://www.w3.org/2000/svg", name);
      for (const [k, v] of Object.entries(attributes)) element.setAttribute(k, v);
      if (text) element.textContent = text;
      box.append(element);
    };
    const words = { fill: "var(--soft)", "font-size": 11, "font-family": "system-ui, sans-serif" };
    svg("rect", { x: left, y: top, width: right - left, height: low - top, fill: "none", stroke: "var(--line)" });
    svg("text", { ...words, x: (left + right) / 2, y: height - 8, "text-anchor": "middle" }, "seconds of rendering");
    svg("text", { ...words, x: left, y: 10 }, "radiance, root mean square");
    if (!all.length) return;
    const range = (values) => { const [a, b] = [Math.min(...values), Math.max(...values)]; return [Math.log(a / 1.3), Math.log(b * 1.3)]; };
    const [x0, x1] = range(all.map((p) => p[0])), [y0, y1] = range(all.map((p) => p[2]));
    const across = (x) => left + (right - left) * (Math.log(x) - x0) / (x1 - x0);
    const down = (y) => low - (low - top) * (Math.log(y) - y0) / (y1 - y0);
    const ticks = (a, b) => [1, 2, 5].flatMap((m) => [-5, -4, -3, -2, -1, 0, 1, 2, 3].map((e) => m * 10 ** e)).filter((t) => Math.log(t) > a && Math.log(t) < b).sort((p, q) => p - q);
    const few = (list) => list.filter((_, k) => k % Math.ceil(list.length / 5) === 0);
    for (const t of few(ticks(x0, x1))) {
      svg("line", { x1: across(t), x2: across(t), y1: top, y2: low, stroke: "var(--line)" });
      svg("text", { ...words, x: across(t), y: low + 14, "text-anchor": "middle" }, String(Number(t.toPrecision(1))));
    }
    for (const t of few(ticks(y0, y1))) {
      svg("line", { x1: left, x2: right, y1: down(t), y2: down(t), stroke: "var(--line)" });
      svg("text", { ...words, x: left - 5, y: down(t) + 4, "text-anchor": "end" }, String(Number(t.toPrecision(1))));
    }
    for (const [name, points] of lines) {
      const style = name === "now" ? { stroke: "var(--plot)", "stroke-width": 2.5 } : { stroke: "var(--soft)", "stroke-width": 1.5, "stroke-dasharray": "4 3" };
      if (points.length > 1) svg("polyline", { points: points.map((p) => `${across(p[0])},${down(p[2])}`).join(" "), fill: "none", ...style });
      if (name === "now") for (const p of points) svg("circle", { cx: across(p[0]), cy: down(p[2]), r: 3.5, fill: "var(--plot)" });
    }
    const last = told.curve[told.curve.length - 1];
    box.setAttribute("aria-label", last ? `Distance from the reference over time: ${last[2].toPrecision(2)} after ${last[0].toFixed(1)} s, ${samples(last[1])}` : "Distance from the reference over time");
    const many = told.sides.course.samples;
    $("curve-legend").replaceChildren(make("i", { class: "line" }), ` your picture now, after 1, 2, 4 ... samples a pixel, against the reference${many ? ` of ${many}` : ""} `, ...(told.curve_before.length ? [make("i", { class: "line before" }), " the same before the last save"] : []));
  }

  // ---- sliders
  let slidersKey = "";
  function sliders(told) {
    const key = JSON.stringify(told.sliders.map((each) => [each.path, each.low, each.high]));
    if (key !== slidersKey) {
      slidersKey = key;
      $("sliders").replaceChildren(...told.sliders.map((each, number) => {
        const choices = each.choices.length ? each.choices : null;
        const input = make("input", { type: "range", id: `slider-${number}`, min: choices ? 0 : each.low, max: choices ? choices.length - 1 : each.high, step: choices ? 1 : each.step });
        const output = make("output", { for: `slider-${number}` });
        input.addEventListener("input", () => {
          const value = choices ? choices[Number(input.value)] : Number(input.value);
          output.textContent = `${value} ${unit(each)}`;
          wish("value", { path: each.path, value });
        });
        return make("label", { for: `slider-${number}` }, each.label, output, input, make("small", {}, each.description));
      }));
    }
    told.sliders.forEach((each, number) => {
      const input = $(`slider-${number}`);
      if (document.activeElement === input && pending) return;
      input.value = each.choices.length ? each.choices.indexOf(each.now) : each.now;
      input.parentElement.querySelector("output").textContent = `${Number(each.now.toPrecision(4))} ${unit(each)}`;
    });
  }
  const unit = (each) => ({ "world unit": "", "1/pixel": "a pixel" }[each.unit] ?? each.unit);

  // ---- wishes that change the scene: one at a time, so that each gets its picture
  let pending = false, awaited = 0, waiting = null, since = 0;
  function wish(kind, told) {
    if (kind === "orbit" && waiting && waiting[0] === "orbit") {
      waiting[1].turn += told.turn;
      waiting[1].tilt += told.tilt;
      waiting[1].zoom *= told.zoom;
    } else {
      if (waiting && waiting[0] !== kind) ask(...waiting);
      waiting = [kind, told];
    }
    flush();
  }
  function flush() {
    if (!waiting || (pending && performance.now() - since < 600)) return;
    const [kind, told] = waiting;
    waiting = null;
    pending = true;
    since = performance.now();
    awaited = state ? state.sides[main].job + 1 : 0;
    ask(kind, told);
    setTimeout(flush, 650);
  }
  const orbit = (turn, tilt, zoom = 1) => wish("orbit", { turn, tilt, zoom });

  for (const name of ["mine", "course", "difference"]) {
    const canvas = $(name);
    let from = null, moved = 0;
    canvas.addEventListener("pointerdown", (event) => {
      if (event.button) return;
      from = [event.clientX, event.clientY];
      moved = 0;
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointermove", (event) => {
      if (!from) return;
      const [dx, dy] = [event.clientX - from[0], event.clientY - from[1]];
      moved += Math.abs(dx) + Math.abs(dy);
      from = [event.clientX, event.clientY];
      if (moved >= 4) orbit(-dx * 0.006, dy * 0.006);
    });
    canvas.addEventListener("pointerup", (event) => {
      if (from && moved < 4) {
        const box = canvas.getBoundingClientRect();
        const [x, y] = [(event.clientX - box.left) / box.width * size[0], (event.clientY - box.top) / box.height * size[1]].map(Math.floor);
        pixel(Math.max(0, Math.min(size[0] - 1, x)), Math.max(0, Math.min(size[1] - 1, y)), name === "difference" ? main : name);
      }
      from = null;
    });
    canvas.addEventListener("pointercancel", () => { from = null; });
    canvas.addEventListener("wheel", (event) => {
      if (document.activeElement !== canvas) return;
      event.preventDefault();
      orbit(0, 0, Math.exp(event.deltaY * 0.001));
    }, { passive: false });
    canvas.addEventListener("keydown", (event) => {
      const step = 0.06;
      const does = {
        ArrowLeft: [-step, 0, 1], ArrowRight: [step, 0, 1], ArrowUp: [0, step, 1], ArrowDown: [0, -step, 1],
        "+": [0, 0, 0.9], "=": [0, 0, 0.9], "-": [0, 0, 1 / 0.9],
      }[event.key];
      if (!does || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      orbit(...does);
    });
  }

  // ---- the story of a pixel
  function below(text, to) {
    $("asked").replaceChildren(text, ...(to ? [" ", make("a", { href: "#story-of" }, "See its rays below.")] : []));
  }
  function pixel(x, y, side) {
    $("x").value = x;
    $("y").value = y;
    put("status", `asking for pixel ${x},${y}`);
    below(`Pixel ${x},${y}: it is being told, below.`);
    $("story").classList.add("old");
    ask("pixel", { x, y, side });
  }
  $("pixel-form").addEventListener("submit", (event) => {
    event.preventDefault();
    pixel(Number($("x").value), Number($("y").value), main);
  });
  function beside(told) {
    // Undefined until the course's rays are there; without a line if they are the same.
    const lines = told.beside;
    if (!lines) return [];
    if (!lines.length) return [make("p", { class: "beside" }, "The course's functions send the same rays.")];
    const lead = told.lead || (told.is_right
      ? `${told.rays.function} is right by the checks. It turns the same numbers into other rays than the course's function does:`
      : `Where ${told.rays.function} departs from the course's function, which got the same numbers:`);
    return [make("div", { class: "beside" }, make("p", {}, lead), make("ul", {}, ...lines.map((line) => make("li", {}, line))))];
  }
  const tree = (lines) => make("ul", {}, ...lines.map(([text, below]) => make("li", {}, text, ...(below.length ? [tree(below)] : []))));
  let storyKey = "";
  function story(told) {
    const root = $("story"), key = JSON.stringify(told);
    // Whoever comes back is told the last one again: what was chosen in its view stays.
    if (key === storyKey) return;
    storyKey = key;
    const place = told.story.join(",");
    root.dataset.pixel = place;
    root.classList.toggle("old", Boolean(told.old));
    [$("x").value, $("y").value] = told.story;
    put("story-told", told.old ? `${told.old}: what stands here is of the picture before. Pixel ${place} is told again as soon as there is a new one.` : "");
    if (told.failed || !told.rays) {
      root.replaceChildren(...(told.failed ? [make("p", { class: "trouble" }, told.failed)] : []));
      below(told.failed ? `Pixel ${place}: ${told.failed}.` : `Pixel ${place}: it is being told, below.`);
      return;
    }
    below(told.old ? `Pixel ${place} is told again: ${told.old.toLowerCase()}.` : `Pixel ${place}: ${told.reason}.`, true);
    if (told.old && root.dataset.of === `${told.job} ${place}`) return;
    root.dataset.of = `${told.job} ${place}`;
    const rays = make("div", { class: "rays" });
    const list = make("details", { open: "" }, make("summary", {}, "What the rays met"), tree(told.tree));
    const whose = told.side === "mine" ? "With your functions, " : viewing ? "" : "With the course's functions, ";
    root.replaceChildren(make("p", { class: "reason" }, `${whose}${told.title}: ${told.reason}.`), ...beside(told), rays, list);
    penumbra.rays(rays, told.rays);
  }

  // ---- functions
  function functions(told) {
    if (viewing) return;
    const points = (n) => Number(n.toFixed(2));
    const all = told.modules.length, done = all - told.waiting;
    const sofar = `${points(told.points)} of ${points(told.of)} points`;
    put("points", !told.waiting ? `${sofar} in all ${all} modules` : `Checking: ${done} of ${all} modules are done${done ? `, ${sofar} so far` : ""}.`);
    $("next").replaceChildren();
    if (told.next) {
      const place = told.where.split(/[\\/]/).slice(-2).join("/");
      $("next").append("Next: ", make("code", {}, told.next), `, ${place}. Read ${told.page}.`);
    }
    const called = new Set(told.needs);
    const module = (each) => make("section", {},
      make("h3", {}, each.name, each.checking ? " (checking)" : ""),
      ...(each.trouble ? [make("p", { class: "hint" }, each.trouble)] : []),
      make("ul", {}, ...each.functions.map((one) => {
        const text = one.state;
        const item = make("li", { class: called.has(`${one.module}.${one.name}`) ? "called" : "", "data-function": `${one.module}.${one.name}`, "data-state": text },
          make("div", {}, make("code", { class: "name" }, one.name), make("span", { class: `state ${text.replaceAll(" ", "-")}` }, text)));
        if (one.title) {
          item.append(make("p", { class: "hint" }, `${one.title}: ${one.found}${/[.?!]$/.test(one.found) ? "" : "."}`), make("p", { class: "hint" }, make("code", {}, one.again)));
        }
        return item;
      })));
    $("modules").replaceChildren(...told.modules.filter((each) => each.here).map(module));
    $("other-modules").replaceChildren(...told.modules.filter((each) => !each.here).map(module));
  }

  // ---- buttons
  $("which").addEventListener("change", () => {
    const canvas = $("difference");
    canvas.getContext("2d").clearRect(0, 0, canvas.width, canvas.height);
    delete shown.difference;
    delete shown.change;
    show(state);
  });
  $("reset").addEventListener("click", () => ask("reset"));
  $("again").addEventListener("click", () => ask("again"));
  $("yaml").addEventListener("click", async () => {
    const answer = await fetch("/view.yaml", { headers: { "X-Token": token } }).catch(() => null);
    if (!answer) {
      put("status", AWAY);
      return;
    }
    $("view-yaml").textContent = await answer.text();
    put("view-told", "");
    $("view").hidden = false;
    $("view-yaml").focus();
  });
  $("copy").addEventListener("click", async () => {
    try {
      await navigator.clipboard.writeText($("view-yaml").textContent);
      put("view-told", "copied");
    } catch {
      getSelection().selectAllChildren($("view-yaml"));
      put("view-told", "selected; copy it with your keyboard");
    }
  });
  $("save").addEventListener("click", async () => {
    const answer = await ask("save");
    put("view-told", answer ? await answer.text() : "The studio doesn't answer: nothing was written.");
  });
  if (viewing) put("course-name", "Picture");

  const events = new EventSource(`/events?token=${encodeURIComponent(token)}`);
  events.addEventListener("state", (event) => show(JSON.parse(event.data)));
  events.addEventListener("functions", (event) => functions(JSON.parse(event.data)));
  events.addEventListener("story", (event) => { story(JSON.parse(event.data)); if (state) show(state); });
  events.onerror = () => put("status", AWAY);
})();
