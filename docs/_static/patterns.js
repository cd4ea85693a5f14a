// Where samples lie: point sets in the unit square, warps from it to the disk and the sphere, and measures of how
// evenly they are spread. Nothing is drawn here. A point set is {x, y}, two Float32Arrays.
"use strict";
window.penumbra ??= {};

penumbra.patterns = (() => {
  const TO_UNIT = 2 ** -24;

  // 32 bits that look nothing like their neighbours'.
  function hashed(word) {
    word = Math.imul(word ^ (word >>> 16), 0x85ebca6b);
    word = Math.imul(word ^ (word >>> 13), 0xc2b2ae35);
    return (word ^ (word >>> 16)) >>> 0;
  }

  // Uniform numbers in [0, 1) of 24 bits: hashes of a counter, which begins where the seed says.
  function generator(seed) {
    let counter = hashed(seed);
    return () => {
      counter = (counter + 0x9e3779b9) | 0;
      return (hashed(counter) >>> 8) * TO_UNIT;
    };
  }

  function points(count, place) {
    const set = { x: new Float32Array(count), y: new Float32Array(count) };
    for (let i = 0; i < count; i++) [set.x[i], set.y[i]] = place(i);
    return set;
  }

  const side = (count) => Math.floor(Math.sqrt(count));

  // The centres of k by k cells, row by row, for the largest k whose square is no more than count.
  function regular(count) {
    const k = side(count);
    return points(k * k, (i) => [((i % k) + 0.5) / k, (Math.floor(i / k) + 0.5) / k]);
  }

  // All x before all y, as the course's functions draw them.
  function random(count, uniform) {
    const set = points(count, () => [0, 0]);
    for (const row of [set.x, set.y]) for (let i = 0; i < count; i++) row[i] = uniform();
    return set;
  }

  // One point anywhere in each of k by k cells.
  function jittered(count, uniform) {
    const k = side(count);
    const { x, y } = random(k * k, uniform);
    const within = (jitter, cell) => Math.fround(jitter + cell) / k;
    return points(k * k, (i) => [within(x[i], i % k), within(y[i], Math.floor(i / k))]);
  }

  // Direction numbers of Sobol's first two dimensions: of each, one for each bit of a point's index.
  const DIRECTIONS = [[], []];
  for (let bit = 0, second = 1; bit < 32; bit++, second = (second ^ (second << 1)) >>> 0) {
    DIRECTIONS[0].push((1 << (31 - bit)) >>> 0);
    DIRECTIONS[1].push((second << (31 - bit)) >>> 0);
  }

  function sobolWord(index, dimension) {
    let word = 0;
    for (let bit = 0; index >>> bit; bit++) if ((index >>> bit) & 1) word ^= DIRECTIONS[dimension][bit];
    return word >>> 0;
  }

  function reversedBits(word) {
    let reversed = 0;
    for (let bit = 0; bit < 32; bit++) reversed = (reversed << 1) | ((word >>> bit) & 1);
    return reversed >>> 0;
  }

  // A nested scramble, as the renderer's: a digit is flipped by chance, the same for equal digits before it.
  function scrambledWord(word, seed) {
    let state = reversedBits(word);
    state ^= Math.imul(state, 0x3d20adea);
    state = (state + seed) | 0;
    state = Math.imul(state, (seed >>> 16) | 1);
    state ^= Math.imul(state, 0x05526c56);
    state ^= Math.imul(state, 0x53a22864);
    return reversedBits(state >>> 0);
  }

  const fraction = (word) => (word >>> 8) * TO_UNIT;

  const sobol = (count) => points(count, (i) => [fraction(sobolWord(i, 0)), fraction(sobolWord(i, 1))]);

  const scrambledSobol = (count, seeds) =>
    points(count, (i) => seeds.map((seed, d) => fraction(scrambledWord(sobolWord(i, d), seed))));

  function mirrored(base, index) {
    let value = 0;
    for (let weight = 1 / base; index > 0; index = Math.floor(index / base), weight /= base) {
      value += (index % base) * weight;
    }
    return value;
  }

  const halton = (count) => points(count, (i) => [mirrored(2, i), mirrored(3, i)]);
  const hammersley = (count) => points(count, (i) => [i / count, mirrored(2, i)]);

  // The patterns by name; chance says whether another seed gives other points.
  const PATTERNS = {
    regular: { chance: false, make: (count) => regular(count) },
    random: { chance: true, make: (count, seed) => random(count, generator(seed)) },
    jittered: { chance: true, make: (count, seed) => jittered(count, generator(seed)) },
    sobol: { chance: false, make: (count) => sobol(count) },
    scrambled: {
      chance: true,
      make: (count, seed) => {
        const uniform = generator(seed);
        return scrambledSobol(count, [0, 1].map(() => Math.floor(uniform() * 2 ** 32)));
      },
    },
    halton: { chance: false, make: (count) => halton(count) },
    hammersley: { chance: false, make: (count) => hammersley(count) },
  };

  // From the unit square to the domain. A mistaken warp takes for uniform what is not.
  function disk(u, v, mistaken) {
    const radius = mistaken ? u : Math.sqrt(u);
    return [radius * Math.cos(2 * Math.PI * v), radius * Math.sin(2 * Math.PI * v)];
  }

  function sphere(u, v, mistaken) {
    const height = mistaken ? Math.cos(Math.PI * u) : 1 - 2 * u;
    const ring = Math.sqrt(Math.max(1 - height * height, 0));
    return [ring * Math.cos(2 * Math.PI * v), ring * Math.sin(2 * Math.PI * v), height];
  }

  const square = (u, v) => [u, v];

  // The largest difference, over all boxes with one corner in the origin, between a box's area and its share of the
  // points. It is reached where both of a box's other sides go through points or along the square's.
  function starDiscrepancy({ x, y }) {
    const count = x.length;
    const order = [...x.keys()].sort((a, b) => x[a] - x[b]);
    const below = []; // y of the points that are to the left, in order
    let worst = 0;
    const compare = (width, strict) => {
      for (let j = 0; j <= below.length; j++) {
        const top = j < below.length ? below[j] : 1;
        // Open boxes have fewer points than their area promises, closed ones more.
        if (strict) worst = Math.max(worst, width * top - j / count);
        else if (j < below.length) worst = Math.max(worst, (j + 1) / count - width * top);
      }
    };
    for (let i = 0; i < count; ) {
      const width = x[order[i]];
      compare(width, true);
      for (; i < count && x[order[i]] === width; i++) insert(below, y[order[i]]);
      compare(width, false);
    }
    compare(1, true);
    return worst;
  }

  function insert(sorted, value) {
    let low = 0;
    for (let high = sorted.length; low < high; ) {
      const middle = (low + high) >> 1;
      if (sorted[middle] < value) low = middle + 1;
      else high = middle;
    }
    sorted.splice(low, 0, value);
  }

  // How many of the cells, columns by rows, hold a point.
  function cellsHit({ x, y }, columns, rows) {
    const hit = new Set();
    const cell = (value, cells) => Math.min(Math.floor(value * cells), cells - 1);
    for (let i = 0; i < x.length; i++) hit.add(cell(y[i], rows) * columns + cell(x[i], columns));
    return hit.size;
  }

  return {
    generator, regular, random, jittered, sobol, scrambledSobol, halton, hammersley, PATTERNS,
    square, disk, sphere, starDiscrepancy, cellsHit,
  };
})();
