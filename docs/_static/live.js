// Pictures that are computed as a slider moves: distribution ray tracing in a fragment shader, beside the same scene
// without the effect. <figure class="computed" data-view="NAME" hidden> asks for one; without WebGL 2 it stays hidden, and the
// page's other pictures are there. One context draws for all figures of a page.
{
  const WIDTH = 360, HEIGHT = 270;
  // The error is measured at a third of the size, against so many samples a pixel.
  const SMALL = 3, CONVERGED = 256;
  // Samples a pixel that are added at a time to a picture that converges.
  const BATCH = 16;
  // Milliseconds after which no more are added: without a graphics card it takes long.
  const PATIENCE = 20000;

  const SHADER = `#version 300 es
precision highp float; precision highp int;
const vec3 EYE = vec3(-0.6, 3.4, 8.6), AT = vec3(-0.6, 1.15, 0);
uniform vec2 size; uniform int samples; uniform uint seed;
uniform float lamp, rough, aperture, focus, shutter, texels, across, height, alpha; uniform bool seamless, sky, board, metal;
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
  if (board) {
    // A board without thickness, and the lamp for whoever looks at it.
    float t = -o.x / d.x; vec3 p = o + t * d;
    if (t > 1e-3 && t < hit.t && p.y > 0.0 && p.y < 1.0 && abs(p.z) < 4.0) hit = Hit(t, vec3(-sign(d.x), 0, 0), vec3(0.62, 0.42, 0.25), 0.0);
    return hit;
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
  vec3 light = (board ? vec3(across, height, 0) : vec3(2.2, 3.6, 1.4)) + lamp * onSphere() - p;
  float square = dot(light, light), cosine = dot(hit.normal, light) * inversesqrt(square);
  vec3 result = hit.albedo * (sky ? 0.35 : 0.14);
  if (cosine > 0.0) {
    Hit blocker = trace(p + 1e-3 * hit.normal, light * inversesqrt(square), time);
    if (blocker.t * blocker.t > square) result += hit.albedo * (sky ? 26.0 : 40.0) / PI * cosine / square;
  }
  return result;
}
// Gold by microfacets: normals that the viewer sees (Heitz 2018), masked by Smith's G2 / G1, Schlick's form of Fresnel.
float smith(float cosine) { return 2.0 / (1.0 + sqrt(1.0 + alpha * alpha * (1.0 / (cosine * cosine) - 1.0))); }
vec3 gold(vec3 d, vec3 n) {
  vec3 x = normalize(cross(n, abs(n.y) < 0.9 ? vec3(0, 1, 0) : vec3(1, 0, 0))), y = cross(n, x);
  vec3 view = -vec3(dot(d, x), dot(d, y), dot(d, n)), m = vec3(0, 0, 1);
  if (alpha > 0.0) {
    vec3 h = normalize(vec3(alpha * view.xy, view.z));
    vec3 a = h.z < 0.9999 ? normalize(vec3(-h.y, h.x, 0)) : vec3(1, 0, 0), b = cross(h, a);
    vec2 p = onDisk();
    p.y = mix(sqrt(1.0 - p.x * p.x), p.y, 0.5 * (1.0 + h.z));
    vec3 v = p.x * a + p.y * b + sqrt(max(0.0, 1.0 - dot(p, p))) * h;
    m = normalize(vec3(alpha * v.xy, max(1e-6, v.z)));
  }
  vec3 out_ = reflect(-view, m);
  if (out_.z <= 0.0) return vec3(0);
  float one = smith(max(1e-4, view.z)), other = smith(max(1e-4, out_.z)), both = 1.0 / (1.0 / one + 1.0 / other - 1.0);
  vec3 fresnel = mix(vec3(1.0, 0.77, 0.34), vec3(1), pow(1.0 - clamp(dot(view, m), 0.0, 1.0), 5.0));
  return (alpha > 0.0 ? both / one : 1.0) * fresnel * scenery(out_.x * x + out_.y * y + out_.z * n);
}
vec3 radiance(vec3 o, vec3 d, float time) {
  if (metal) {
    Hit hit = Hit(1e9, vec3(0), vec3(0), 0.0);
    ball(hit, o, d, vec3(0, 0.55, 0), 1.25, vec3(1), 0.0);
    return hit.t < 1e8 ? gold(d, hit.normal) : scenery(d);
  }

  Hit hit = trace(o, d, time);
  if (board) {
    Hit shining = Hit(hit.t, vec3(0), vec3(0), 0.0);
    ball(shining, o, d, vec3(across, height, 0), max(lamp, 0.03), vec3(0), 0.0);
    if (shining.t < hit.t) return vec3(1.0, 0.9, 0.6);
  }
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
  if (board) { eye = EYE; forward = normalize(AT - eye); }
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
    across: ["Lamp, to the side of the board", 0.6, 3, 0.01, 1.4],
    height: ["Lamp, above the floor", 1.6, 3.4, 0.01, 2.6],
    alpha: ["Roughness", 0, 1, 0.01, 0.3],
  };
  const OFF = { lamp: 0, rough: 0, aperture: 0, focus: 5, shutter: 0, texels: 6, seamless: 0, sky: 0, across: 0, height: 0, board: 0, alpha: 0, metal: 0 };
  const VIEWS = {
    home: { knobs: ["lamp", "rough", "aperture", "shutter"], names: ["One ray each", "Distributed rays"], off: ["lamp", "rough", "aperture", "shutter"], converges: 256, hint: "Move a slider to 0: its effect is gone. " },
    soft_shadows: { knobs: ["lamp", "across", "height"], names: ["A point", "A ball"], off: ["lamp"], start: { lamp: 0.4 }, fixed: { board: 1 }, converges: 256, over: penumbra, shows: "a board, its shadow and a lamp", hint: "Drag the lamp in a picture. " },
    microfacets: { knobs: ["alpha"], names: ["Smooth gold", "Rough gold"], off: ["alpha"], fixed: { metal: 1 }, converges: 256, beside: lobe, shows: "a ball by a lake", hint: "Drag the blue ray. " },
    glossy: { knobs: ["rough"], names: ["A mirror", "A glossy one"], off: ["rough"] },
    thin_lens: { knobs: ["aperture", "focus"], names: ["A pinhole", "A lens"], off: ["aperture"] },
    motion_blur: { knobs: ["shutter"], names: ["A moment", "While the shutter is open"], off: ["shutter"] },
    cube_map: { knobs: ["texels"], names: ["Clamped at the edges", "Seamless"], off: ["seamless"], fixed: { sky: 1, seamless: 1 } },
  };

  // ---- the penumbra of the board's upper edge, which is 1 above the floor, by geometry
  // Lines through the edge that touch the ball; where they meet the floor, x on it.
  const bounds = ({ lamp, across, height }) => {
    const away = Math.hypot(across, height - 1), middle = Math.atan2(height - 1, across), half = Math.asin(Math.min(1, lamp / away));
    return [middle + half, middle - half].map((angle) => -1 / Math.tan(Math.max(angle, 0.02)));
  };
  const EYE = [-0.6, 3.4, 8.6], AT = [-0.6, 1.15, 0], FIELD = 0.62;
  const onPicture = ([x, y, z]) => {
    const d = [x - EYE[0], y - EYE[1], z - EYE[2]], length = Math.hypot(AT[1] - EYE[1], AT[2] - EYE[2]);
    const forward = [0, (AT[1] - EYE[1]) / length, (AT[2] - EYE[2]) / length], up = [0, -forward[2], forward[1]];
    const deep = d[1] * forward[1] + d[2] * forward[2], scale = HEIGHT / FIELD / deep;
    return [WIDTH / 2 + scale * d[0], HEIGHT / 2 - scale * (d[1] * up[1] + d[2] * up[2])];
  };
  function penumbra(canvas, values) {
    const pen = canvas.getContext("2d"), ends = bounds(values);
    // In the plane of the lamp: from the ball over the edge to the floor, and how wide that is.
    pen.lineWidth = 1.5;
    ends.forEach((x, k) => {
      const { lamp, across, height } = values, angle = Math.atan2(1, -x), side = k ? -1 : 1;
      const touch = [across - side * lamp * Math.sin(angle), height + side * lamp * Math.cos(angle), 0];
      pen.strokeStyle = "#ffd25e";
      pen.beginPath();
      [touch, [x, 0, 0]].map(onPicture).forEach((p, n) => (n ? pen.lineTo(...p) : pen.moveTo(...p)));
      pen.stroke();
      pen.strokeStyle = "#ff5a4a";
      pen.beginPath();
      [[x, 0, -1.2], [x, 0, 1.2]].map(onPicture).forEach((p, n) => (n ? pen.lineTo(...p) : pen.moveTo(...p)));
      pen.stroke();
    });
    const { lamp, across, height } = values, a = Math.hypot(across, height - 1);
    const b = Math.hypot(1, across / (height - 1)), wide = Math.abs(ends[0] - ends[1]);
    return `By geometry: the ball is ${(2 * lamp).toFixed(2)} across and ${a.toFixed(2)} from the edge, the floor ${b.toFixed(2)} behind it. The lines that touch ball and edge meet the floor ${wide.toFixed(2)} apart: so wide is the penumbra. D b / a is ${((2 * lamp * b) / a).toFixed(2)}, across the rays.`;
  }

  // ---- the lobe of rough gold in the plane of the view, with the factors of its brdf; the viewer's ray is dragged
  const ggx = (cosine, alpha) => alpha ** 2 / (Math.PI * (cosine ** 2 * (alpha ** 2 - 1) + 1) ** 2);
  const smith = (cosine, alpha) => 2 / (1 + Math.sqrt(1 + alpha ** 2 * (1 / cosine ** 2 - 1)));
  const factors = (from, to, alpha) => {
    const half = (to - from) / 2, [i, o] = [Math.cos(from), Math.cos(to)];
    const [d, g1, other] = [ggx(Math.cos(half), alpha), smith(i, alpha), smith(o, alpha)];
    const g2 = 1 / (1 / g1 + 1 / other - 1), f = 0.77 + 0.23 * (1 - Math.cos((from + to) / 2)) ** 5;
    return { d, g1, g2, f, brdf: (f * d * g2) / (4 * i * o), light: (f * d * g2) / (4 * i) };
  };
  function lobe(values, changed) {
    const box = document.createElement("div"), canvas = document.createElement("canvas"), said = document.createElement("p");
    const width = 2 * WIDTH, height = 300, [x, y, long] = [width / 2, 270, 230];
    let degrees = 40;
    [canvas.width, canvas.height] = [width, height];
    box.className = "lobe";
    said.className = "geometry";
    canvas.tabIndex = 0;
    for (const [name, value] of [["role", "slider"], ["aria-label", "Angle of the viewer's ray, in degrees from the normal"], ["aria-valuemin", 0], ["aria-valuemax", 85]]) canvas.setAttribute(name, value);
    canvas.classList.add("dragged");
    box.append(canvas, said);
    const draw = () => {
      const pen = canvas.getContext("2d"), look = getComputedStyle(figureOf(box)), from = (degrees * Math.PI) / 180, alpha = Math.max(values.alpha, 0.02);
      const at = (angle, r) => [x + r * Math.sin(angle), y - r * Math.cos(angle)];
      const line = (points, colour, wide) => {
        pen.strokeStyle = colour;
        pen.lineWidth = wide;
        pen.beginPath();
        points.forEach((p, n) => (n ? pen.lineTo(...p) : pen.moveTo(...p)));
        pen.stroke();
      };
      pen.clearRect(0, 0, width, height);
      const angles = Array.from({ length: 721 }, (_, n) => ((n - 360) / 360) * 1.5533);
      const lights = angles.map((to) => factors(from, to, alpha).light), most = Math.max(...lights), peak = angles[lights.indexOf(most)];
      const ink = look.color, lobeOf = "#d08a00";
      line([[20, y], [width - 20, y]], ink, 1.5);
      line([at(0, 0), at(0, long)], ink, 0.75);
      line([at(from, 0), at(from, long)], ink, 0.75);
      line([at(-from, long), at(-from, 0)], "#2a7de1", 3);
      line(angles.map((to, n) => at(to, (long * lights[n]) / most)), lobeOf, 3);
      line([at(peak, 0), at(peak, long)], lobeOf, 1);
      pen.fillStyle = ink;
      pen.font = "15px system-ui, sans-serif";
      pen.fillText("viewer", ...at(-from - 0.03, long + 12).map((p, n) => p - (n ? 0 : 46)));
      pen.fillText("mirrored", ...at(from, long + 14));
      const there = factors(from, peak, alpha), told = (angle) => `${Math.round((angle * 180) / Math.PI)}\u00b0`;
      canvas.setAttribute("aria-valuenow", degrees);
      said.textContent = `Seen from ${told(from)}, roughness ${values.alpha}: the lobe is brightest at ${told(peak)}. There D = ${there.d.toPrecision(3)} a steradian is the density of mirrors that face halfway; G1 = ${there.g1.toFixed(3)} of them are seen, G2 = ${there.g2.toFixed(3)} are seen and lit, and they return F = ${there.f.toFixed(3)} of green light: the brdf is F D G2 / (4 cos cos) = ${there.brdf.toPrecision(3)}.`;
    };
    const turn = (to) => {
      degrees = Math.max(0, Math.min(85, Math.round(to)));
      draw();
    };
    const follow = (event) => {
      const frame = canvas.getBoundingClientRect(), scale = width / frame.width;
      turn((Math.atan2(x - (event.clientX - frame.left) * scale, y - (event.clientY - frame.top) * scale) * 180) / Math.PI);
    };
    canvas.addEventListener("pointerdown", (event) => { canvas.setPointerCapture(event.pointerId); follow(event); });
    canvas.addEventListener("pointermove", (event) => { if (event.buttons) follow(event); });
    canvas.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: 1, ArrowUp: 1, ArrowRight: -1, ArrowDown: -1 }[event.key];
      if (!step) return;
      event.preventDefault();
      turn(degrees + step);
    });
    changed.push(draw);
    return box;
  }
  const figureOf = (element) => element.closest("figure") ?? document.body;

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
      for (const name of ["lamp", "rough", "aperture", "focus", "shutter", "texels", "across", "height", "alpha"]) gl.uniform1f(at(name), values[name]);
      for (const name of ["seamless", "sky", "board", "metal"]) gl.uniform1i(at(name), values[name]);
      gl.drawArrays(gl.TRIANGLES, 0, 3);
      return { canvas, gl };
    });
  };

  const LINEAR = Float32Array.from({ length: 256 }, (_, k) => (k < 11 ? k / 255 / 12.92 : ((k / 255 + 0.055) / 1.055) ** 2.4));
  const pixels = (values, samples, seed, shrink = SMALL) => {
    const [width, height] = [WIDTH / shrink, HEIGHT / shrink];
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

  // The lamp follows the pointer, in the plane through it that faces the viewer.
  const dragged = (canvases, values, inputs) => {
    for (const { canvas } of canvases) {
      canvas.classList.add("dragged");
      let from = null;
      canvas.addEventListener("pointerdown", (event) => {
        from = [event.clientX, event.clientY, values.across, values.height];
        canvas.setPointerCapture(event.pointerId);
      });
      canvas.addEventListener("pointermove", (event) => {
        if (!from) return;
        const unit = (onPicture([1, 2, 0])[0] - onPicture([0, 2, 0])[0]) * canvas.clientWidth / WIDTH;
        for (const [name, value] of [["across", from[2] + (event.clientX - from[0]) / unit], ["height", from[3] - (event.clientY - from[1]) / unit]]) {
          const input = inputs[KNOBS[name][0]];
          input.value = value;
          input.dispatchEvent(new Event("input"));
        }
      });
      for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, () => { from = null; });
    }
  };

  const started = (figure, view) => {
    const values = { ...OFF, ...view.fixed };
    let samples = 16, waiting = 0, drawn = 0, round = 0;
    const pair = document.createElement("div");
    pair.className = "pair";
    const canvases = view.names.map((name) => {
      const box = document.createElement("div"), canvas = document.createElement("canvas"), said = document.createElement("p");
      [canvas.width, canvas.height] = [WIDTH, HEIGHT];
      canvas.setAttribute("role", "img");
      canvas.setAttribute("aria-label", `${name}: ${view.shows ?? "balls and posts on a tiled floor"}`);
      box.append(canvas, said);
      pair.append(box);
      return { canvas, said, name };
    });
    const knobs = document.createElement("div");
    knobs.className = "knobs";
    const without = () => ({ ...values, ...Object.fromEntries(view.off.map((name) => [name, OFF[name]])) });
    const both = () => [without(), { ...values }];

    const geometry = document.createElement("p");
    geometry.className = "geometry";
    const over = () => both().forEach((each, k) => view.over && (geometry.textContent = view.over(canvases[k].canvas, each)));
    const draw = (shrink) => {
      const begun = performance.now();
      both().forEach((each, k) => {
        const { canvas, gl } = made()(each, WIDTH / shrink, HEIGHT / shrink, samples, 1);
        gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
        canvases[k].canvas.getContext("2d").drawImage(canvas, 0, 0, WIDTH, HEIGHT);
      });
      over();
      drawn = (performance.now() - begun) * shrink * shrink;
    };
    const measure = (samples) => {
      const truth = pixels(values, CONVERGED, 2);
      both().forEach((each, k) => {
        const off = error(pixels(each, samples, 1), truth).toFixed(4);
        canvases[k].said.textContent = `${canvases[k].name}, ${samples} ${samples === 1 ? "sample" : "samples"} a pixel: error ${off}`;
      });
    };
    // Samples are added while one looks, in linear radiance.
    const converge = () => {
      const mine = ++round, begun = performance.now(), sums = both().map(() => new Float32Array(4 * WIDTH * HEIGHT));
      let done = 0;
      const add = () => {
        if (mine !== round) return;
        done += 1;
        both().forEach((each, k) => {
          const codes = pixels(each, BATCH, done, 1), shown = new ImageData(WIDTH, HEIGHT);
          for (let n = 0; n < codes.length; n++) {
            // The first row is the lowest one.
            const row = HEIGHT - 1 - Math.floor(n / 4 / WIDTH), place = 4 * (row * WIDTH + (n / 4 | 0) % WIDTH) + n % 4;
            sums[k][n] += n % 4 < 3 ? LINEAR[codes[n]] : 1;
            const light = sums[k][n] / done;
            shown.data[place] = 255 * (n % 4 === 3 ? 1 : light < 0.0031308 ? 12.92 * light : 1.055 * light ** (1 / 2.4) - 0.055);
          }
          canvases[k].canvas.getContext("2d").putImageData(shown, 0, 0);
          canvases[k].said.textContent = `${canvases[k].name}, ${done * BATCH} samples a pixel so far`;
        });
        over();
        if (done * BATCH < view.converges && performance.now() - begun < PATIENCE) requestAnimationFrame(add);
        else measure(done * BATCH);
      };
      add();
    };
    const whole = () => (view.converges ? converge() : (draw(1), measure(samples)));
    // Where drawing is slow, moving pictures are small, and the whole follows when the slider rests.
    const others = [];
    const changed = () => {
      for (const each of others) each();
      cancelAnimationFrame(waiting);
      round += 1;
      waiting = requestAnimationFrame(() => {
        draw(drawn > 100 ? 3 : 1);
        clearTimeout(figure.rest);
        figure.rest = setTimeout(whole, 200);
      });
    };
    const inputs = {};
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
      inputs[text] = input;
      label.append(`${text} `, input, output);
      knobs.append(label);
    };
    for (const name of view.knobs) {
      const [text, low, high, step, start] = KNOBS[name];
      knob(text, low, high, step, view.start?.[name] ?? start, (value) => (values[name] = value), (value) => String(value));
    }
    // Few samples of a large lamp err by more than none of its size does.
    if (!view.converges) knob("Samples a pixel", 0, 6, 1, view.start?.samples ?? 4, (value) => (samples = 2 ** value), (value) => String(2 ** value));
    const caption = document.createElement("figcaption");
    caption.textContent =
      `${view.hint ?? ""}Computed here, by your graphics card or in its place. Errors: root mean square of linear radiance against ` +
      `${CONVERGED} samples of the right picture, at a third of the size. More samples lower the right one's; the left one keeps its bias.`;
    figure.append(pair, ...(view.beside ? [view.beside(values, others)] : []), ...(view.over ? [geometry] : []), knobs, caption);
    figure.hidden = false;
    for (const each of others) each();
    if (view.over) dragged(canvases, values, inputs);
    whole();
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
