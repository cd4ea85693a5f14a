"""Mistakes in the good scene of conftest.py: what is changed in its text, and with which message it is refused."""

from tests.tables import rows

FORMAT = rows("""
eye: [ -> eye: [0, | 4: camera.eye is [0, 0, 1, 5]: expected 3 numbers [world unit]
eye: [0, -> eye: [a, | 4: camera.eye[0] is "a": expected a number [world unit]
eye: [0, -> eye: [true, | 4: camera.eye[0] is true: expected a number [world unit]
vertical_fov: 35 -> vertical_fov: 180 | 7: camera.vertical_fov is 180: expected a number > 0 and < 180 [degree]
width: 64 -> width: 0 | 8: film.width is 0: expected a whole number from 1 to 65536 [pixel]
width: 64 -> width: 6.5 | 8: film.width is 6.5: expected a whole number from 1 to 65536 [pixel]
sigma: 0.2 -> sigma: 0 | 8: film.sigma is 0: expected a number >= 0.02 [pixel]
filter: gaussian -> filter: gausian | 8: film.filter is "gausian": expected box or gaussian; did you mean gaussian?
filter: gaussian -> filter: [box] | 8: film.filter is ["box"]: expected box or gaussian
seed: 7 -> seed: -1 | 2: seed is -1: expected a whole number from 0 to 4294967295
title: everything -> title: 3 | 1: title is 3: expected a text
cutoff: 1e-3 -> cutoff: 1 | 10: integrator.cutoff is 1: expected a number >= 0 and < 1
radiance: [0.1, 0.2, 0.3] -> radiance: [0.1, -0.2, 0.3] | 11: environment.radiance[1] is -0.2: expected a number >=
    0 [W/(m^2 sr)]
color: [1, 0, 0] -> color: red | 13: materials.red.color is "red": expected a number from 0 to 1, 3 numbers from 0
    to 1 or null
color: [1, 0, 0] -> color: [1, 0] | 13: materials.red.color is [1, 0]: expected a number from 0 to 1, 3 numbers from
    0 to 1 or null
diffuse: 0.9 -> diffuse: -1.5 | 13: materials.red.diffuse is -1.5: expected a number from 0 to 1000000
mirror: {mirror: 0.9} -> mirror: 3 | 14: materials.mirror is 3: expected a map with keys such as color, ambient,
    diffuse
refraction_index: 1.5 -> refraction_index: 0 | 16: materials.glass.dielectric.refraction_index is 0: expected a
    number > 0
dielectric: {refraction_index: 1.5, absorption: [0.1, 0, 0.2]} -> dielectric: 1.5 |
    16: materials.glass.dielectric is 1.5: expected a map or null
radius: 0, intensity -> radius: -1, intensity | 22: lights[4].radius is -1: expected a number >= 0 [world unit]
intensity: [10, 20, 30] -> intensity: bright | 19: lights[1].intensity is "bright": expected a number >= 0 or 3
    numbers >= 0 [W/sr]
size: [1, 2, 3] -> size: [1, 0, 3] | 28: objects[1].size[1] is 0: expected a number > 0 [world unit]
segments: 32 -> segments: 2 | 33: objects[2].segments is 2: expected a whole number from 3 to 4096
- scale: -2 -> - scale: [1, 2] | 31: objects[1].transform[1].scale is [1, 2]: expected a number or 3 numbers
degrees: 30 -> degrees: yes | 32: objects[1].transform[2].rotate.degrees is "yes": expected a number [degree]
file: bunny.ply -> file: '' | 41: objects[10].file is "": expected a text that is not empty
look_at: -> look_att: | 5: camera.look_att: unknown key; did you mean look_at?
title: every -> Title: every | 1: Title: unknown key; did you mean title?
mirror: 0.9 -> colour: 0.9 | 14: materials.mirror.colour: unknown key; did you mean color?
refraction_index: 1.5 -> bend: 1.5 | 16: materials.glass.dielectric.bend: unknown key; known are refraction_index,
    absorption, shaded, roughness, distribution, surrounded_by
width: 10, -> widht: 10, | 24: objects[0].widht: unknown key; did you mean width?
- scale: -2 -> - move: -2 | 31: objects[1].transform[1].move: unknown key; known are translate, scale, rotate,
    matrix
- scale: -2 -> - scal: -2 | 31: objects[1].transform[1].scal: unknown key; did you mean scale?
- scale: -2 -> - <step>: scale | 31: objects[1].transform[1]["<step>"]: unknown key; known are translate, scale,
    rotate, matrix
axis: [0, 1, 0], -> axes: [0, 1, 0], | 32: objects[1].transform[2].rotate.axes: unknown key; did you mean axis?
eye: [0, 1, 5] -> | 3: camera: eye is missing: expected 3 numbers [world unit]
position: [1, 2, 3], -> | 19: lights[1]: position is missing: expected 3 numbers [world unit]
material: mirror -> | 25: objects[1]: material is missing: expected a text that is not empty
type: point, -> | 19: lights[1]: type is missing: expected ambient, point, spot, directional, rectangle,
    sphere or object
type: constant, -> | 11: environment: type is missing: expected constant, cube, lat_long, angular or backdrop
shape: disk, -> | 34: objects[3]: shape is missing: expected quad, box, sphere, disk, cylinder, cone, torus,
    torus_knot, displaced_sphere, height_field or mesh
, degrees: 30 -> | 32: objects[1].transform[2].rotate: degrees is missing: expected a number [degree]
shape: torus, -> shape: tors, | 37: objects[6].shape is "tors": expected quad, box, sphere, disk, cylinder, cone,
    torus, torus_knot, displaced_sphere, height_field or mesh; did you mean torus?
shape: disk -> shape: 3 | 34: objects[3].shape is 3: expected quad, box, sphere, disk, cylinder, cone, torus,
    torus_knot, displaced_sphere, height_field or mesh
shape: disk -> shape: [disk] | 34: objects[3].shape is ["disk"]: expected quad, box, sphere, disk, cylinder, cone,
    torus, torus_knot, displaced_sphere, height_field or mesh
type: point -> type: pint | 19: lights[1].type is "pint": expected ambient, point, spot, directional, rectangle,
    sphere or object; did you mean point?
type: constant -> type: sky | 11: environment.type is "sky": expected constant, cube, lat_long, angular or backdrop
type: jittered -> type: faure | 9: sampler.type is "faure": expected blue_noise, chained, dithered, halton,
    hammersley, jittered, random, regular, sobol or xorshift
- scale: -2 -> - 3 | 31: objects[1].transform[1] is 3: expected a map with one key, translate, scale, rotate or matrix
- scale: -2 -> - {scale: 2, <step>: 3} | 31: objects[1].transform[1]["<step>"]: unknown key; known are translate,
    scale, rotate, matrix
- scale: -2 -> - {} | 31: objects[1].transform[1]: a step with 0 keys: expected one, translate, scale, rotate or
    matrix; each step is an item of its own
- scale: -2 -> - {scale: 2, translate: [0, 0, 0]} | 31: objects[1].transform[1]: a step with 2 keys: expected one,
    translate, scale, rotate or matrix; each step is an item of its own
p: 3, q: 4 -> p: 33, q: 4 | 38: objects[7].p is 33: expected a whole number from 1 to 32
p: 3, q: 4 -> p: 3, q: 34 | 38: objects[7].q is 34: expected a whole number from 1 to 32
p: 3, q: 4 -> p: 3, q: 4, sides: 1025 | 38: objects[7].sides is 1025: expected a whole number from 3 to 1024
p: 3, q: 4 -> p: 3, q: 4, segments: 15 | 38: objects[7].segments is 15: expected a whole number from 16 to 16384
""")
"""What one value or one key is wrong with."""

CONTRADICTIONS = rows("""
samples: 9 -> samples: 10 | 9: sampler.samples is 10: expected a square number for the jittered sampler, such as 9
    or 16
type: jittered, samples: 9 -> type: regular, samples: 65535 |
    9: sampler.samples is 65535: expected a square number for the regular sampler, such as 65025 or 65536
, radiance: 5 -> | 21: lights[3]: intensity or radiance is missing: expected one of them, in W/sr or W/(m^2 sr)
, radiance: 5 -> , radiance: 5, intensity: 5 | 21: lights[3]: both intensity and radiance are given: expected one of
    them
radius: 0, intensity: 3 -> radius: 1 | 22: lights[4]: intensity or radiance is missing: expected one of them, in
    W/sr or W/(m^2 sr)
radius: 0, intensity: 3 -> radius: 0, radiance: 3 | 22: lights[4].radius is 0: expected a number > 0 [world unit]
    for a light by radiance; a point has no area to emit from
radius: 0, intensity: 3 -> radius: 1, radiance: 3, samples: facing disk |
    22: lights[4].samples is "facing disk": expected "sphere", "sphere by polar" or "visible" for a light by
    radiance, which shines from its surface; by intensity it may be a ball or a facing disk
radius: 0, intensity: 3 -> radius: 1, intensity: 3, samples: visible |
    22: lights[4].samples is "visible": expected "sphere", "ball" or "facing disk" (or "sphere by polar", "ball by
    polar", "ball by rejection") for a light by intensity: all of it shines everywhere, and only a light by radiance
    has a side that can't be seen
direction: [0, -1, 0] -> direction: [0, 0, -0.0] | 20: lights[2].direction is [0, 0, -0.0]: expected a vector that
    is not zero
edge_u: [1, 0, 0] -> edge_u: [0, 0, 0] | 21: lights[3].edge_u is [0, 0, 0]: expected a vector that is not zero
edge_v: [0, 0, 1] -> edge_v: [0, 0, 0] | 21: lights[3].edge_v is [0, 0, 0]: expected a vector that is not zero
edge_v: [0, 0, 1] -> edge_v: [-3, 0, 0] | 21: lights[3].edge_v is [-3, 0, 0]: expected an edge that is not parallel
    to edge_u
material: glass -> material: glas | 33: objects[2].material is "glas": expected the name of one of the materials;
    did you mean glass?
material: glass -> material: wood | 33: objects[2].material is "wood": expected the name of one of the materials;
    known are red, mirror, glass
- scale: -2 -> - scale: 0 | 31: objects[1].transform[1].scale is 0: expected factors that are not 0
- scale: -2 -> - scale: [1, 0.0, 1] | 31: objects[1].transform[1].scale is [1, 0.0, 1]: expected factors that are
    not 0
axis: [0, 1, 0] -> axis: [0, 0, 0] | 32: objects[1].transform[2].rotate.axis is [0, 0, 0]: expected a vector that is
    not zero
p: 3, q: 4 -> p: 6, q: 4 | 38: objects[7]: p is 6 and q is 4: expected numbers without a common divisor; these wind
    2 times over the same curve
p: 3, q: 4 -> p: 3, q: 4, segments: 55 | 38: objects[7].segments is 55: expected a whole number from 56, which is 8
    (p + q), to 16384
shape: torus, -> shape: torus, radius: 2, tube: 2.0, | 37: objects[6].tube is 2.0: expected a number < radius, 2
    [world unit]
shape: torus, -> shape: torus, radius: 0.25, |
    37: objects[6].radius is 0.25: expected a number > tube, 0.25 where it is not given [world unit]
shape: displaced_sphere, -> shape: displaced_sphere, amplitude: 1, |
    39: objects[8].amplitude is 1: expected a number < radius, 1 [world unit]
shape: displaced_sphere, -> shape: displaced_sphere, radius: 0.1, |
    39: objects[8].radius is 0.1: expected a number > amplitude, 0.1 where it is not given [world unit]
""")
"""What takes more than one key to see, or the geometry."""

SYNONYMS = rows("""
vertical_fov: 35 -> fov: 35 | vertical_fov
vertical_fov: 35 -> FOV: 35 | vertical_fov
eye: -> position: | eye
look_at: -> target: | look_at
look_at: [0, 0.5, 0] -> direction: [0, 0, -1] | look_at
width: 10, -> position: [0, 1, 0], | transform: [{translate: [0, 1, 0]}]
width: 10, -> rotation: [0, 90, 0], | transform: [{rotate: {axis: [0, 1, 0], degrees: 90}}]
width: 10, -> scale: 2, | transform: [{scale: 2}]
width: 10, -> size: 2, | width or depth
- scale: -2 -> - translation: [0, 1, 0] | translate
radius: 0.5, -> size: 0.5, | radius
shape: disk -> type: disk | shape
position: [1, 2, 3] -> pos: [1, 2, 3] | position
center: [0, 4, 0] -> position: [0, 4, 0] | center
intensity: [10, 20, 30] -> color: [10, 20, 30] | intensity
intensity: [10, 20, 30] -> power: 10 | intensity
radius: 0, intensity: 3 -> radius: 1, color: 3 | radiance or intensity
irradiance: 1 -> color: 1 | irradiance
type: ambient, radiance -> type: ambient, color | radiance
refraction_index: 1.5 -> ior: 1.5 | refraction_index
mirror: 0.9 -> ior: 1.5 | dielectric: {refraction_index: 1.5}
""")
"""Keys as other programs call them; the message is what was meant."""
