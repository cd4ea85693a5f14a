// Lets readers drag points of a figure, by the pointer or with the arrow keys. A figure with data-model names a model of
// drag_models.js, which says where the points of its drawing are and what its numbers are; elements of the drawing say in
// data-at at which points they lie. Without this script the drawing is at rest.
"use strict";
{
  const SVG = "http://www.w3.org/2000/svg";
  const made = (tag, attributes, ...children) => {
    const element = document.createElementNS(SVG, tag);
    for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
    element.append(...children);
    return element;
  };
  const shown = (number, digits) => (Number.isFinite(number) ? number.toFixed(digits) : "∞");
  const said = (template, numbers) => template.replace(/\{(\w+):\.(\d)f\}/g, (_, name, digits) => shown(numbers[name], Number(digits)));

  const start = (figure) => {
    const svg = figure.querySelector("svg");
    const model = penumbra.models[figure.dataset.model];
    const ranges = JSON.parse(figure.dataset.values);
    const [mx, my, sx, sy, cx, cy] = svg.dataset.frame.split(" ").map(Number);
    const pixel = ([x, y]) => [(x - mx) * sx + cx, (y - my) * sy + cy];
    const plane = ([x, y]) => [(x - cx) / sx + mx, (y - cy) / sy + my];
    const rest = Object.fromEntries(Object.entries(ranges).map(([name, [, , value]]) => [name, value]));
    let values = { ...rest };

    // "p" is a point of the model, "p:3" one of a row, "=1,2" a fixed one. "p/q/4/5" lies 4 units of the drawing from p
    // towards q and 5 to the left; "p/q/50%/5" half of the way.
    const named = (name, points) => {
      if (name[0] === "=") return [name.slice(1).split(",").map(Number)];
      const [row, place] = name.split(":");
      const found = points[row];
      if (place !== undefined) return [found[place]];
      return Array.isArray(found[0]) ? found : [found];
    };
    const spots = (words, points) =>
      words.split(" ").flatMap((word) => {
        const [p, q, along, left] = word.split("/");
        const from = named(p, points).map(pixel);
        if (q === undefined) return from;
        const [[ax, ay], [bx, by]] = [from[0], pixel(named(q, points)[0])];
        const length = Math.hypot(bx - ax, by - ay) || 1, [dx, dy] = [(bx - ax) / length, (by - ay) / length];
        const way = along.endsWith("%") ? (parseFloat(along) / 100) * length : Number(along);
        return [[ax + way * dx + left * dy, ay + way * dy - left * dx]];
      });

    const drawn = [...svg.querySelectorAll("[data-at]")];
    const first = model(rest).points;
    const offsets = new Map(drawn.filter((each) => each.tagName === "text").map((text) => {
      const [[x, y]] = spots(text.dataset.at, first);
      return [text, [text.getAttribute("x") - x, text.getAttribute("y") - y]];
    }));
    const put = (element, pairs) => {
      for (const [name, value] of Object.entries(pairs)) element.setAttribute(name, value.toFixed(2));
    };
    const place = (element, points, numbers) => {
      const [a, b] = spots(element.dataset.at, points);
      if (element.tagName === "line") put(element, { x1: a[0], y1: a[1], x2: b[0], y2: b[1] });
      else if (element.tagName === "text") put(element, { x: a[0] + offsets.get(element)[0], y: a[1] + offsets.get(element)[1] });
      else if (element.tagName === "circle") {
        put(element, { cx: a[0], cy: a[1] });
        if (element.dataset.radius) put(element, { r: numbers[element.dataset.radius] * Math.abs(sx) });
      } else {
        element.setAttribute("points", spots(element.dataset.at, points).map(([x, y]) => `${x.toFixed(2)},${y.toFixed(2)}`).join(" "));
      }
    };

    const draw = () => {
      const { points, numbers } = model(values);
      for (const element of drawn) place(element, points, numbers);
      for (const output of figure.querySelectorAll("[data-number]")) {
        output.textContent = shown(numbers[output.dataset.number], Number(output.dataset.digits));
      }
      for (const { handle, element } of handles) {
        const [x, y] = pixel(points[handle.point]);
        element.setAttribute("transform", `translate(${x.toFixed(2)} ${y.toFixed(2)})`);
        element.setAttribute("aria-valuenow", values[handle.keys[0]]);
        element.setAttribute("aria-valuetext", said(handle.says, { ...numbers, ...values }));
      }
    };
    // Values stay in their ranges; NaN, as where a model can't tell, changes nothing.
    const change = (wanted) => {
      for (const [name, value] of Object.entries(wanted)) {
        const [low, high] = ranges[name];
        if (!Number.isNaN(value)) values[name] = Math.min(high, Math.max(low, value));
      }
      draw();
    };

    const handles = JSON.parse(figure.dataset.handles).map((handle) => {
      const [low, high] = ranges[handle.keys[0]];
      const element = made("g",
        { class: "handle", tabindex: 0, role: "slider", "aria-label": handle.name, "aria-valuemin": low, "aria-valuemax": high },
        made("circle", { class: "reach", r: 16 }), made("circle", { class: "grip", r: 6.5 }));
      let held = null;
      const pointed = (event) => {
        const { x, y } = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
        return [x, y];
      };
      element.addEventListener("pointerdown", (event) => {
        if (event.button !== 0) return;
        element.setPointerCapture(event.pointerId);
        const at = pointed(event), [x, y] = pixel(model(values).points[handle.point]);
        held = [x - at[0], y - at[1]];
        element.focus({ preventScroll: true });
        event.preventDefault();
      });
      element.addEventListener("pointermove", (event) => {
        if (!held || !element.hasPointerCapture(event.pointerId)) return;
        const at = pointed(event);
        change(model.drag[handle.point](plane([at[0] + held[0], at[1] + held[1]]), values));
      });
      element.addEventListener("keydown", (event) => {
        const [across, up = across] = handle.keys;
        const large = event.shiftKey ? 10 : 1;
        const steps = {
          ArrowRight: [across, large], ArrowLeft: [across, -large], ArrowUp: [up, large], ArrowDown: [up, -large],
          PageUp: [up, 10], PageDown: [up, -10], Home: [across, -Infinity], End: [across, Infinity],
        }[event.key];
        if (!steps || event.altKey || event.ctrlKey || event.metaKey) return;
        const [name, count] = steps, [low, high, , step] = ranges[name];
        const to = Number.isFinite(count) ? values[name] + count * step : count < 0 ? low : high;
        change({ [name]: Number(to.toFixed(9)) });
        event.preventDefault();
        event.stopPropagation();
      });
      svg.append(element);
      return { handle, element };
    });

    const again = document.createElement("button");
    again.type = "button";
    again.textContent = "As at first";
    again.addEventListener("click", () => { values = { ...rest }; draw(); });
    const hint = document.createElement("p");
    hint.className = "hint";
    hint.append("Drag the rings, or move them with the arrow keys. ", again);
    const readout = figure.querySelector(".readout");
    readout.setAttribute("aria-live", "polite");
    readout.after(hint);
    // What has parts that can be focused is no picture any more.
    svg.setAttribute("role", "group");
    figure.classList.add("draggable");
    draw();
  };

  document.querySelectorAll("figure[data-model]").forEach(start);
}
