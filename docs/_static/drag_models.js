// Where the points of the figures that can be dragged are, and their numbers, for given values: what the Python files of
// docs/sitebuild/diagrams say by the course's functions. A model has drag[POINT], which tells the values for which the point
// is where it is dragged to. Nothing is drawn here.
"use strict";
window.penumbra ??= {};

penumbra.models = (() => {
  const range = (count) => Array.from({ length: count }, (_, k) => k);
  const spread = (low, high, count) => range(count).map((k) => low + ((high - low) * k) / (count - 1));
  const mean = (list) => list.reduce((sum, each) => sum + each, 0) / list.length;
  // Where the line through a and b meets the line through c and d.
  const meeting = ([ax, ay], [bx, by], [cx, cy], [dx, dy]) => {
    const det = (bx - ax) * (cy - dy) - (cx - dx) * (by - ay);
    const s = ((cx - ax) * (cy - dy) - (cx - dx) * (cy - ay)) / det;
    return [ax + s * (bx - ax), ay + s * (by - ay)];
  };

  const penumbraModel = (v) => {
    const lamp = [v.lamp_x, v.lamp_y], edge = [v.edge_x, v.edge_y], other = [v.edge_x - v.width, v.edge_y], place = [v.place, 0];
    const lo = [v.lamp_x - v.diameter / 2, v.lamp_y], hi = [v.lamp_x + v.diameter / 2, v.lamp_y];
    const onFloor = (from, past) => meeting(from, past, [0, 0], [1, 0]);
    const begin = onFloor(hi, edge), end = onFloor(lo, edge), leftBegin = onFloor(hi, other), leftEnd = onFloor(lo, other);
    const tip = begin[0] < leftEnd[0] ? meeting(hi, edge, lo, other) : null;
    const share = (x) => {
      const [first, last] = [other[0], edge[0]].map((to) => x + ((to - x) * lo[1]) / edge[1]);
      return 1 - Math.max(Math.min(last, hi[0]) - Math.max(first, lo[0]), 0) / (hi[0] - lo[0]);
    };
    const points = range(12).map((k) => [lo[0] + (v.diameter * (k + 0.5)) / 12, lo[1]]);
    const crossings = points.map(([x]) => [place[0] + ((x - place[0]) * edge[1]) / lamp[1], edge[1]]);
    const hidden = crossings.map(([x]) => other[0] <= x && x <= edge[0]);
    const arriving = points.map(([x, y], k) => (hidden[k] ? 0 : y / ((x - place[0]) ** 2 + y * y) ** 1.5));
    const plotted = (x) => [x, -1.35 + 0.8 * share(x)];
    return {
      points: {
        lamp, lo, hi, edge, other, begin, end, left_begin: leftBegin, left_end: leftEnd,
        dark_right: tip ?? begin, dark_left: tip ?? leftEnd,
        high: [2.25, lamp[1]], middle: [2.25, edge[1]], low: [2.25, 0], place,
        free: points.map((point, k) => (hidden[k] ? place : point)),
        stopped: crossings.map((point, k) => (hidden[k] ? point : place)),
        seen: spread(-2.6, 2.6, 105).map(plotted), plotted: plotted(place[0]),
      },
      numbers: {
        penumbra: (v.diameter * edge[1]) / (lamp[1] - edge[1]), umbra: Math.max(0, begin[0] - leftEnd[0]), share: share(place[0]),
        free: hidden.filter((each) => !each).length, irradiance: mean(arriving), radius: v.diameter / 2,
      },
    };
  };
  penumbraModel.drag = {
    lamp: ([x, y]) => ({ lamp_x: x, lamp_y: y }),
    hi: ([x], v) => ({ diameter: 2 * (x - v.lamp_x) }),
    edge: ([x, y]) => ({ edge_x: x, edge_y: y }),
    other: ([x], v) => ({ width: v.edge_x - x }),
    place: ([x]) => ({ place: x }),
  };

  const lensModel = (v) => {
    const FOCAL = 1.3;
    const imageOf = (distance) => (distance === FOCAL ? Infinity : (FOCAL * distance) / (distance - FOCAL));
    const film = imageOf(v.focus), image = imageOf(v.depth);
    const circle = (2 * v.radius * Math.abs(v.focus - v.depth)) / v.depth;
    const past = Math.max(v.focus, v.depth);
    const sides = { top: v.radius, bottom: -v.radius };
    const points = {
      focused: [v.focus, 0], point: [v.depth, 0], sharp: [-film, 0], plane_top: [v.focus, 1.3], plane_bottom: [v.focus, -1.3],
      film_top: [-film, 1.2], film_bottom: [-film, -1.2], film_foot: [-film, -1.3], lens_foot: [0, -1.3],
      circle_top: [v.focus, circle / 2], circle_bottom: [v.focus, -circle / 2],
    };
    for (const [name, y] of Object.entries(sides)) {
      points[name] = [0, y];
      points[`spot_${name}`] = [-film, y * (1 - film / image)];
      points[`past_${name}`] = [past, y * (1 - past / v.depth)];
    }
    const spot = Math.abs(points.spot_top[1] - points.spot_bottom[1]);
    return { points, numbers: { film, image, spot, circle, focus: v.focus, depth: v.depth } };
  };
  lensModel.drag = {
    top: ([, y]) => ({ radius: y }),
    point: ([x]) => ({ depth: x }),
    plane_top: ([x]) => ({ focus: x }),
  };

  const turned = (degrees, length = 1) => [length * Math.cos((degrees * Math.PI) / 180), length * Math.sin((degrees * Math.PI) / 180)];
  const lobeDensity = (cosine, exponent) => (cosine < 0 ? 0 : ((exponent + 1) / (2 * Math.PI)) * cosine ** exponent);
  // A direction of a lobe about [x, y, z].
  const lobeDirection = ([x, y, z], exponent, [u, turn]) => {
    const logarithm = Math.log1p(-u) / (exponent + 1), sine = Math.sqrt(-Math.expm1(2 * logarithm));
    const a = sine * Math.cos(2 * Math.PI * turn), b = sine * Math.sin(2 * Math.PI * turn), c = Math.exp(logarithm);
    const sign = z < 0 ? -1 : 1, sunk = sign * x * a + y * b, rest = c - sunk / (sign + z);
    return [x * rest + a, y * rest + sign * b, c * z - sunk];
  };

  const lobeModel = (v) => {
    const exponent = Math.log(0.5) / Math.log(Math.cos((v.half * Math.PI) / 180));
    const axis = turned(v.angle), side = Math.atan2(-axis[0], axis[1]) / (2 * Math.PI);
    const sampled = range(9).map((k) => lobeDirection([...axis, 0], exponent, [(k + 0.5) / 9, (side + 0.5 * (k % 2) + 1) % 1]));
    const kept = sampled.map(([x, y]) => [x, Math.abs(y)]);
    const middle = lobeDensity(1, exponent);
    const angles = kept.map(([, y]) => (Math.acos(y) * 180) / Math.PI);
    return {
      points: {
        floor: [0, 0], source: turned(180 - v.angle, 2.4), mirrored: turned(v.angle, 1.75),
        shape: spread(-90, 90, 121).map((t) => turned(v.angle + t, (1.5 * lobeDensity(Math.cos((t * Math.PI) / 180), exponent)) / middle)),
        side: turned(v.angle + v.half, 2.1), low: turned(v.angle - v.half, 2.1),
        arc: spread(-v.half, v.half, 25).map((t) => turned(v.angle + t, 2.1)),
        directions: kept.map(([x, y]) => [3 * x, 3 * y]),
      },
      numbers: {
        exponent, half: v.half, middle, below: sampled.filter(([, y]) => y < 0).length,
        steepest: Math.min(...angles), flattest: Math.max(...angles),
      },
    };
  };
  const degreesOf = ([x, y]) => (Math.atan2(y, x) * 180) / Math.PI;
  lobeModel.drag = {
    source: ([x, y]) => ({ angle: degreesOf([-x, y]) }),
    side: (at, v) => ({ half: degreesOf(at) - v.angle }),
  };

  const densityModel = ({ exponent }) => {
    const POWER = 3, COUNT = 10, BOTTOM = -1.35, UNIT = 0.95 / (2 * Math.PI);
    const numbers = range(COUNT).map((k) => (k + ((k * 0.61803398875) % 1)) / COUNT);
    const z = numbers.map((u) => lobeDirection([0, 0, 1], exponent, [u, 0])[2]).sort((a, b) => a - b);
    const quotients = z.map((cosine) => cosine ** POWER / lobeDensity(cosine, exponent));
    const average = mean(quotients);
    const variance = quotients.reduce((sum, each) => sum + (each - average) ** 2, 0) / (COUNT - 1) / COUNT;
    const density = spread(0, 1, 61).map((x) => [x, (2 * Math.PI * lobeDensity(x, exponent)) / (POWER + 1)]);
    const left = 2 * POWER + 1 - exponent;
    const exact = left > 0 ? (2 * Math.PI) ** 2 / ((exponent + 1) * left) : Infinity;
    return {
      points: {
        area: [...density, [1, 0], [0, 0]], density, top: density.at(-1),
        feet: z.map((x) => [x, BOTTOM]), samples: z.map((x) => [x, 0]), said: z.map((x, k) => [x, BOTTOM + UNIT * quotients[k]]),
        mean_left: [0, BOTTOM + UNIT * average], mean_right: [1.05, BOTTOM + UNIT * average],
      },
      numbers: { exponent, mean: average, error: Math.sqrt(variance), variance: exact - ((2 * Math.PI) / (POWER + 1)) ** 2 },
    };
  };
  densityModel.drag = { top: ([, y]) => ({ exponent: 4 * y - 1 }) };

  const streakModel = (v) => {
    const RADIUS = 0.3, HIGH = 0.6, BOTTOM = -0.5, TALL = 0.8;
    const clipped = (time) => Math.min(v.close, Math.max(v.open, time));
    const covered = (x) => (clipped((x + RADIUS) / v.speed) - clipped((x - RADIUS) / v.speed)) / (v.close - v.open);
    const places = (count) => range(count).map((k) => v.speed * (v.open + ((v.close - v.open) * (k + 0.5)) / count));
    const begin = v.speed * v.open, end = v.speed * v.close, here = covered(v.place);
    const curve = spread(-1.7, 1.7, 341).map((x) => [x, BOTTOM + TALL * covered(x)]);
    return {
      points: {
        begin: [begin, HIGH], end: [end, HIGH],
        ...Object.fromEntries(places(5).map((x, k) => [`frame${k}`, [x, HIGH]])),
        start: [0, 0.16], tip: [v.speed / 3, 0.16], curve, area: [...curve, [1.7, BOTTOM], [-1.7, BOTTOM]],
        place: [v.place, BOTTOM], above: [v.place, HIGH], kept: [v.place, BOTTOM + TALL * here],
      },
      numbers: {
        streak: end - begin + 2 * RADIUS, most: covered((begin + end) / 2), here,
        hits: places(20).filter((x) => Math.abs(x - v.place) <= RADIUS).length, time: v.close - v.open,
      },
    };
  };
  streakModel.drag = {
    begin: ([x], v) => ({ open: x / v.speed }),
    end: ([x], v) => ({ close: x / v.speed }),
    tip: ([x]) => ({ speed: 3 * x }),
    place: ([x]) => ({ place: x }),
  };

  return {
    "soft_shadows/penumbra": penumbraModel,
    "thin_lens/lens": lensModel,
    "glossy/lobe": lobeModel,
    "importance_sampling/lobe": densityModel,
    "motion_blur/film": streakModel,
  };
})();
