// Pictures that are computed as a slider moves: distribution ray tracing in a fragment shader, beside the same scene
// without the effect. <figure class="computed" data-view="NAME" hidden> asks for one; without WebGL 2 it stays hidden, and the
// page's other pictures are there. One context draws for all figures of a page.
{
  const WIDTH = 360, HEIGHT = 270;
  // The error is measured at a third of the size, against so many samples a pixel.
  const SMALL = 3, CONVERGED = 256;

  const SHADER = `#version 300 es
precision highp float; precision highp int;
uniform vec2 size; uniform int samples; uniform uint seed;
uniform float lamp, rough, aperture, focus, shutter, texels; uniform bool seamless, sky;
out vec4 color;
const float PI = 3.14159265;
uint state;
// PCG, O'Neill 2014.
float number() {
  state = state * 747796405u + 2891336453u;
  uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return float(((word >> 22u) ^ word) >> 8u) / 16777216.0;
}
vec3 onSphere() {
  float z = 1.0 - 2.0 * number(), phi = 2.0 * PI * number();
  return vec3(sqrt(max(0.0, 1.0 - z * z)) * vec2(cos(phi), sin(phi)), z);
}
vec3 inBall() { vec3 way = onSphere(); return way * pow(number(), 1.0 / 3.0); }
vec2 onDisk() { float r = sqrt(number()), phi = 2.0 * PI * number(); return r * vec2(cos(phi), sin(phi)); }

struct Hit { float t; vec3 normal; vec3 albedo; float mirror; };
void ball(inout Hit hit, vec3 o, vec3 d, vec3 center, float radius, vec3 albedo, float mirror) {
  vec3 m = o - center;
  float b = dot(m, d), c = dot(m, m) - radius * radius, q = b * b - c;
  if (q < 0.0) return;
  float t = -b - sqrt(q);
  if (t > 1e-3 && t < hit.t) hit = Hit(t, (m + t * d) / radius, albedo, mirror);
}
void post(inout Hit hit, vec3 o, vec3 d, vec2 foot, float radius, float top) {
  vec2 m = o.xz - foot; float a = dot(d.xz, d.xz), b = dot(m, d.xz), q = b * b - a * (dot(m, m) - radius * radius);
  if (q > 0.0) {
    float t = (-b - sqrt(q)) / a, y = o.y + t * d.y;
    if (t > 1e-3 && t < hit.t && y > 0.0 && y < top) {
      vec2 n = (m + t * d.xz) / radius;
      hit = Hit(t, vec3(n.x, 0.0, n.y), vec3(0.75, 0.7, 0.6), 0.0);
    }
  }
  float t = (top - o.y) / d.y; vec2 p = o.xz + t * d.xz - foot;
  if (t > 1e-3 && t < hit.t && dot(p, p) < radius * radius) hit = Hit(t, vec3(0, 1, 0), vec3(0.75, 0.7, 0.6), 0.0);
}
Hit trace(vec3 o, vec3 d, float time) {
  Hit hit = Hit(1e9, vec3(0), vec3(0), 0.0);
  float t = -o.y / d.y;
  if (t > 1e-3) {
    vec2 p = o.xz + t * d.xz;
    float tile = mod(floor(p.x * 1.5) + floor(p.y * 1.5), 2.0);
    if (length(p) < 14.0) hit = Hit(t, vec3(0, 1, 0), mix(vec3(0.42, 0.4, 0.38), vec3(0.66, 0.63, 0.58), tile), 0.0);
  }
  if (sky) {
    ball(hit, o, d, vec3(0, 1.05, 0), 1.05, vec3(0.95, 0.93, 0.9), 1.0);
    return hit;
  }
  ball(hit, o, d, vec3(0.05, 0.6, -0.2), 0.6, vec3(0.86, 0.84, 0.8), 1.0);
  ball(hit, o, d, vec3(-1.35, 0.45, 0.5), 0.45, vec3(0.75, 0.25, 0.16), 0.0);
  ball(hit, o, d, vec3(1.15 + 0.9 * shutter * (time - 0.5), 0.32, 0.85), 0.32, vec3(0.12, 0.45, 0.5), 0.0);
  ball(hit, o, d, vec3(1.6, 0.5, -2.2), 0.5, vec3(0.75, 0.55, 0.15), 0.0);
  post(hit, o, d, vec2(-0.75, -1.1), 0.09, 1.9);
  post(hit, o, d, vec2(-1.75, -1.6), 0.09, 1.9);
  return hit;
}
vec3 scenery(vec3 d) {
  float hills = 0.12 + 0.07 * sin(5.0 * atan(d.x, d.z)) + 0.04 * sin(13.0 * atan(d.x, d.z));
  vec3 up = mix(vec3(0.95, 0.72, 0.5), vec3(0.2, 0.38, 0.75), sqrt(clamp(d.y, 0.0, 1.0)));
  up += vec3(4.0, 3.4, 2.4) * smoothstep(0.985, 0.99, dot(d, normalize(vec3(-0.6, 0.5, 0.6))));
  vec3 below = vec3(0.24, 0.22, 0.18);
  return mix(mix(up, vec3(0.1, 0.2, 0.14), smoothstep(0.01, -0.01, d.y - hills)), below, smoothstep(0.01, -0.01, d.y));
}
// A cube map of so many texels along an edge: across an edge a seamless lookup goes on, a clamped one stays.
vec3 cube(vec3 d) {
  vec3 a = abs(d), middle, right, down;
  if (a.x >= a.y && a.x >= a.z) { middle = vec3(sign(d.x), 0, 0); right = vec3(0, 0, 1); down = vec3(0, 1, 0); }
  else if (a.y >= a.z) { middle = vec3(0, sign(d.y), 0); right = vec3(1, 0, 0); down = vec3(0, 0, 1); }
  else { middle = vec3(0, 0, sign(d.z)); right = vec3(1, 0, 0); down = vec3(0, 1, 0); }
  d /= dot(d, middle);
  vec2 place = (vec2(dot(d, right), dot(d, down)) * 0.5 + 0.5) * texels - 0.5, first = floor(place), share = place - first;
  vec3 sum = vec3(0);
  for (int k = 0; k < 4; k++) {
    vec2 corner = vec2(k & 1, k >> 1), texel = first + corner;
    if (!seamless) texel = clamp(texel, 0.0, texels - 1.0);
    vec2 at = (texel + 0.5) / texels * 2.0 - 1.0, weight = mix(1.0 - share, share, corner);
    sum += weight.x * weight.y * scenery(normalize(middle + at.x * right + at.y * down));
  }
  return sum;
}
vec3 background(vec3 d) { return sky ? cube(d) : mix(vec3(0.30, 0.32, 0.36), vec3(0.16, 0.2, 0.3), clamp(d.y * 2.0, 0.0, 1.0)); }
vec3 lit(vec3 p, Hit hit, float time) {
  vec3 light = vec3(2.2, 3.6, 1.4) + lamp * onSphere() - p;
  float square = dot(light, light), cosine = dot(hit.normal, light) * inversesqrt(square);
  vec3 result = hit.albedo * (sky ? 0.35 : 0.14);
  if (cosine > 0.0) {
    Hit blocker = trace(p + 1e-3 * hit.normal, light * inversesqrt(square), time);
    if (blocker.t * blocker.t > square) result += hit.albedo * (sky ? 26.0 : 40.0) / PI * cosine / square;
  }
  return result;
}
vec3 radiance(vec3 o, vec3 d, float time) {
  Hit hit = trace(o, d, time);
  float through = 1.0;
  if (hit.t < 1e8 && hit.mirror > 0.0) {
    o += hit.t * d + 1e-3 * hit.normal;
    d = reflect(d, hit.normal);
    vec3 jittered = normalize(d + rough * inBall()), n = hit.normal;
    d = jittered - 2.0 * min(0.0, dot(jittered, n)) * n;
    through = hit.albedo.x;
    hit = trace(o, d, time);
  }
  return through * (hit.t < 1e8 ? lit(o + hit.t * d, hit, time) : background(d));
}
void main() {
  uvec2 pixel = uvec2(gl_FragCoord.xy);
  vec3 sum = vec3(0), eye = vec3(0.2, 1.75, 5.6), forward = normalize(vec3(0.0, 0.55, 0) - eye);
  vec3 right = normalize(cross(forward, vec3(0, 1, 0))), up = cross(right, forward);
  for (int i = 0; i < samples; i++) {
    state = (pixel.x * 1973u + pixel.y * 9277u + uint(i) * 26699u + seed * 101119u) | 1u;
    number(); number();
    vec2 p = (floor(gl_FragCoord.xy) + vec2(number(), number()) - 0.5 * size) / size.y * 0.62;
    vec3 d = forward + p.x * right + p.y * up;
    vec2 onLens = aperture * onDisk();
    vec3 o = eye + onLens.x * right + onLens.y * up;
    sum += min(radiance(o, normalize(eye + focus * d - o), number()), vec3(8.0));
  }
  sum /= float(samples);
  color = vec4(mix(12.92 * sum, 1.055 * pow(max(sum, vec3(0)), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, sum)), 1);
}`;

  const KNOBS = {
    lamp: ["Radius of the lamp", 0, 1.2, 0.01, 0.5],
    rough: ["Roughness of the mirror", 0, 0.8, 0.01, 0.25],
    aperture: ["Radius of the lens", 0, 0.3, 0.005, 0.1],
    focus: ["Distance in focus", 3, 9, 0.05, 4.8],
    shutter: ["Time that the shutter is open", 0, 1, 0.01, 0.7],
    texels: ["Texels along an edge of the cube", 2, 32, 1, 6],
  };
  const OFF = { lamp: 0, rough: 0, aperture: 0, focus: 5, shutter: 0, texels: 6, seamless: 0, sky: 0 };
  const VIEWS = {
    home: { knobs: ["lamp", "rough", "aperture", "shutter"], names: ["One ray each", "Distributed rays"], off: ["lamp", "rough", "aperture", "shutter"], hint: "Move a slider to 0: its effect is gone. " },
    soft_shadows: { knobs: ["lamp"], names: ["A point", "A ball"], off: ["lamp"], start: { lamp: 0.7, samples: 6 } },
    glossy: { knobs: ["rough"], names: ["A mirror", "A glossy one"], off: ["rough"] },
    thin_lens: { knobs: ["aperture", "focus"], names: ["A pinhole", "A lens"], off: ["aperture"] },
    motion_blur: { knobs: ["shutter"], names: ["A moment", "While the shutter is open"], off: ["shutter"] },
    cube_map: { knobs: ["texels"], names: ["Clamped at the edges", "Seamless"], off: ["seamless"], fixed: { sky: 1, seamless: 1 } },
  };

  let drawer = null;
  const made = () => {
    if (drawer !== null) return drawer;
    const canvas = document.createElement("canvas");
    const gl = canvas.getContext("webgl2", { preserveDrawingBuffer: true });
    if (!gl) return (drawer = false);
    const program = gl.createProgram();
    const corner = "#version 300 es\nvoid main(){gl_Position=vec4(4*(gl_VertexID&1)-1,4*(gl_VertexID>>1)-1,0,1);}";
    for (const [kind, text] of [[gl.VERTEX_SHADER, corner], [gl.FRAGMENT_SHADER, SHADER]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) return (drawer = false);
    gl.useProgram(program);
    const at = (name) => gl.getUniformLocation(program, name);
    return (drawer = (values, width, height, samples, seed) => {
      [canvas.width, canvas.height] = [width, height];
      gl.viewport(0, 0, width, height);
      gl.uniform2f(at("size"), width, height);
      gl.uniform1i(at("samples"), samples);
      gl.uniform1ui(at("seed"), seed);
      for (const name of ["lamp", "rough", "aperture", "focus", "shutter", "texels"]) gl.uniform1f(at(name), values[name]);
      for (const name of ["seamless", "sky"]) gl.uniform1i(at(name), values[name]);
      gl.drawArrays(gl.TRIANGLES, 0, 3);
      return { canvas, gl };
    });
  };

  const LINEAR = Float32Array.from({ length: 256 }, (_, k) => (k < 11 ? k / 255 / 12.92 : ((k / 255 + 0.055) / 1.055) ** 2.4));
  const pixels = (values, samples, seed) => {
    const [width, height] = [WIDTH / SMALL, HEIGHT / SMALL];
    const { gl } = made()(values, width, height, samples, seed);
    const codes = new Uint8Array(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, codes);
    return codes;
  };
  // Root of the mean squared difference of linear radiance; what is brighter than white counts as white.
  const error = (a, b) => {
    let sum = 0;
    for (let k = 0; k < a.length; k++) if (k % 4 < 3) sum += (LINEAR[a[k]] - LINEAR[b[k]]) ** 2;
    return Math.sqrt(sum / (0.75 * a.length));
  };

  const started = (figure, view) => {
    const values = { ...OFF, ...view.fixed };
    let samples = 16, waiting = 0, drawn = 0;
    const pair = document.createElement("div");
    pair.className = "pair";
    const canvases = view.names.map((name) => {
      const box = document.createElement("div"), canvas = document.createElement("canvas"), said = document.createElement("p");
      [canvas.width, canvas.height] = [WIDTH, HEIGHT];
      canvas.setAttribute("role", "img");
      canvas.setAttribute("aria-label", `${name}: balls and posts on a tiled floor`);
      box.append(canvas, said);
      pair.append(box);
      return { canvas, said, name };
    });
    const knobs = document.createElement("div");
    knobs.className = "knobs";
    const without = () => ({ ...values, ...Object.fromEntries(view.off.map((name) => [name, OFF[name]])) });
    const both = () => [without(), { ...values }];

    const draw = (shrink) => {
      const begun = performance.now();
      both().forEach((each, k) => {
        const { canvas, gl } = made()(each, WIDTH / shrink, HEIGHT / shrink, samples, 1);
        gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
        canvases[k].canvas.getContext("2d").drawImage(canvas, 0, 0, WIDTH, HEIGHT);
      });
      drawn = (performance.now() - begun) * shrink * shrink;
    };
    const measure = () => {
      const truth = pixels(values, CONVERGED, 2);
      both().forEach((each, k) => {
        const off = error(pixels(each, samples, 1), truth).toFixed(4);
        canvases[k].said.textContent = `${canvases[k].name}, ${samples} ${samples === 1 ? "sample" : "samples"} a pixel: error ${off}`;
      });
    };
    // Where drawing is slow, moving pictures are small, and the whole follows when the slider rests.
    const changed = () => {
      cancelAnimationFrame(waiting);
      waiting = requestAnimationFrame(() => {
        draw(drawn > 100 ? 3 : 1);
        clearTimeout(figure.rest);
        figure.rest = setTimeout(() => (draw(1), measure()), 200);
      });
    };
    const knob = (text, low, high, step, start, set, shown) => {
      const label = document.createElement("label"), input = document.createElement("input"), output = document.createElement("output");
      Object.assign(input, { type: "range", min: low, max: high, step, value: start });
      const apply = () => {
        set(Number(input.value));
        output.textContent = shown(Number(input.value));
        input.setAttribute("aria-valuetext", output.textContent);
      };
      input.addEventListener("input", () => (apply(), changed()));
      apply();
      label.append(`${text} `, input, output);
      knobs.append(label);
    };
    for (const name of view.knobs) {
      const [text, low, high, step, start] = KNOBS[name];
      knob(text, low, high, step, view.start?.[name] ?? start, (value) => (values[name] = value), (value) => String(value));
    }
    // Few samples of a large lamp err by more than none of its size does.
    knob("Samples a pixel", 0, 6, 1, view.start?.samples ?? 4, (value) => (samples = 2 ** value), (value) => String(2 ** value));
    const caption = document.createElement("figcaption");
    caption.textContent =
      `${view.hint ?? ""}Computed here, by your graphics card or in its place. Errors: root mean square of linear radiance against ` +
      `${CONVERGED} samples of the right picture, at a third of the size. More samples lower the right one's; the left one keeps its bias.`;
    figure.append(pair, knobs, caption);
    figure.hidden = false;
    draw(1);
    measure();
  };

  const marked = new Map();
  const seen = new IntersectionObserver((entries) => {
    for (const entry of entries) {
      if (!entry.isIntersecting) continue;
      seen.unobserve(entry.target);
      const figure = marked.get(entry.target);
      if (made()) started(figure, VIEWS[figure.dataset.view]);
    }
  }, { rootMargin: "400px" });
  // A hidden figure is nowhere, so its place is marked by an empty line before it.
  for (const figure of document.querySelectorAll("figure.computed")) {
    const mark = document.createElement("div");
    figure.before(mark);
    marked.set(mark, figure);
    seen.observe(mark);
  }
}
