"""Mitsuba's LLVM variant as a distribution ray tracer: an integrator in Python, compiled by Dr.Jit to one kernel.

Mitsuba's own integrators do other work than ours: `path` follows light between diffuse surfaces, draws one light for
each sample instead of all, and knows neither Blinn-Phong, nor lights given by intensity that have a size, nor our
lobes. What follows here is exactly the light paths of ours, and no slower than `path` with plugins for the missing
parts: all geometry is one mesh, materials are rows of a table, and nothing is called through a pointer.

A scene that moves is one Mitsuba scene for each velocity, and rays are shifted into its frame: Mitsuba has no motion.
Symbols as in ``course.engine.core``: ng, ns geometric and shading normals on the incoming side.
"""

import math
from typing import Any

import numpy as np

from benchmarks.mitsuba_export import LOBES, Exported, NotExportableError
from benchmarks.mitsuba_variants import ROBUST, Sensors


def make_mesh(
    name: str,
    vertices: np.ndarray,
    normals: np.ndarray,
    triangles: np.ndarray,
    properties: Any = None,
) -> Any:
    """A Mitsuba mesh with smooth normals; properties may hold its BSDF and its emitter."""
    import mitsuba as mi

    mesh = mi.Mesh(
        name,
        len(vertices),
        len(triangles),
        has_vertex_normals=True,
        props=properties or mi.Properties(),
    )
    values = mi.traverse(mesh)
    values["vertex_positions"] = np.ravel(vertices)
    values["vertex_normals"] = np.ravel(normals)
    values["faces"] = np.ravel(triangles)
    values.update()
    return mesh


class LlvmScene:
    """A scene in Mitsuba's LLVM variant, which ``start_llvm`` must have switched on.

    Raises NotExportableError: a light is one by radiance, such as an object.
    ``exported``: the scene; ``robust``: in Embree's robust mode, which lets no ray slip between two triangles.
    """

    def __init__(self, exported: Exported, robust: bool = False) -> None:
        for light in exported.lights:
            if "radiance" in light:
                raise NotExportableError(
                    f"a light of type {light['type']} by radiance is left to Mitsuba's own emitters: the scalar form"
                    " (NativeScene, which the LLVM variant runs as well) has them, this one has not"
                )
        import mitsuba as mi

        scenes = []
        for number, part in enumerate(exported.parts):
            content: dict[str, Any] = {"type": "scene", ROBUST: robust}
            content["mesh"] = make_mesh(
                f"part {number}", part.vertices, part.normals, part.triangles
            )
            scenes.append(mi.load_dict(content))
        self._scene = scenes[0]
        self._integrator = _integrator_class()(exported, scenes)
        self._sensors = Sensors(exported, exported.shutter if len(scenes) > 1 else 0.0)

    def render(self, sampler: str, samples: int, seed: int) -> np.ndarray:
        """A picture (H, W, 3) float32; some samplers take more samples than were asked for."""
        picture = self._integrator.render(
            self._scene, self._sensors[sampler], seed=seed, spp=samples
        )
        return np.array(picture)

    def samples(self, sampler: str, samples: int) -> int:
        """How many samples the sampler really takes."""
        return self._sensors.samples(sampler, samples)


def _integrator_class() -> type:
    """The integrator; made late, for its base class is another one in each variant."""
    import drjit as dr
    import mitsuba as mi

    class DistributionIntegrator(mi.SamplingIntegrator):  # type: ignore[misc,name-defined]
        """Direct light from all lights, and mirrored and refracted rays, to the scene's depth."""

        def __init__(self, exported: Exported, scenes: list[Any]) -> None:
            super().__init__(mi.Properties())
            self._e = exported
            self._scenes = scenes
            m, parts = exported.materials, exported.parts
            corners = np.cumsum([0, *(len(part.vertices) for part in parts)])
            self._first = np.cumsum([0, *(len(part.triangles) for part in parts)]).tolist()
            self._vertices = _floats([part.vertices for part in parts])
            self._normals = _floats([part.normals for part in parts])
            self._faces = _integers(
                [part.triangles + first for part, first in zip(parts, corners, strict=False)]
            )
            self._material = _integers([part.material for part in parts])
            self._rows = {
                name: _floats([getattr(m, name)])
                for name in m.__dataclass_fields__
                if name != "lobe"
            }
            self._lobe = _integers([m.lobe])
            self._cube = _floats([exported.cube])
            bounces = bool(m.mirror.max() > exported.cutoff or m.refraction_index.any())
            self._depth = exported.max_depth if bounces else 0
            if ((m.refraction_index > 0) & ((m.mirror.max(1) > 0) | (m.lobe > 0))).any():
                raise NotExportableError("glass that also mirrors is not exported")
            if m.metal.any() or m.alpha.any():
                raise NotExportableError("metals and microfacets are left to Mitsuba's own plugins")

        def sample(
            self, scene: Any, sampler: Any, ray: Any, medium: Any = None, active: Any = True
        ) -> Any:
            """Radiance of one wavefront of camera rays."""
            ray, active = mi.Ray3f(ray), mi.Bool(active)
            if self._depth == 0:
                one = mi.Color3f(1), mi.Float(1)
                radiance, *_ = self._step(sampler, ray, *one, mi.UInt32(0), active, True)
            else:
                radiance = self._follow(sampler, ray, active)
            return radiance, mi.Bool(True), []

        def _follow(self, sampler: Any, ray: Any, active: Any) -> Any:
            def deeper(
                sampler: Any,
                radiance: Any,
                ray: Any,
                weight: Any,
                share: Any,
                depth: Any,
                active: Any,
            ) -> Any:
                seen, ray, weight, share, active = self._step(
                    sampler, ray, weight, share, depth, active, depth == 0
                )
                return sampler, radiance + seen, ray, weight, share, depth + 1, active

            start = mi.Color3f(0), ray, mi.Color3f(1), mi.Float(1), mi.UInt32(0), active
            return dr.while_loop((sampler, *start), lambda *state: state[-1], deeper)[1]

        def _step(
            self,
            sampler: Any,
            ray: Any,
            weight: Any,
            share: Any,
            depth: Any,
            active: Any,
            coherent: Any,
        ) -> Any:
            """One depth: what the rays bring, and the rays that go on.

            ``weight`` is the throughput over the probability of having come here, ``share`` that probability: their
            product is the throughput of ours, which follows both ways at glass, and is what the cutoff is about.
            """
            t, p, ng, ns, front, material = self._nearest(ray, coherent, active)
            hit = active & (t < math.inf)
            radiance = dr.select(active & ~hit, weight * self._background(ray.d, active & ~hit), 0)
            if self._rows_used("absorption"):
                through = hit & ~front & (self._row("refraction_index", material, hit) > 0)
                absorbed = dr.exp(-self._row("absorption", material, hit) * t)
                weight = dr.select(through, weight * absorbed, weight)
            there = dr.zeros(mi.SurfaceInteraction3f)
            there.p, there.n, there.time = p, ng, ray.time
            lit = self._row("ambient", material, hit)
            for light in self._e.lights:
                lit += self._direct(light, sampler, ray, there, ns, material, hit)
            if self._e.sky:
                lit += self._sky(sampler, there, ns, material, hit)
            radiance = dr.select(hit, weight * lit, radiance)
            if self._depth == 0:
                return radiance, ray, weight, share, mi.Bool(False)
            direction, factor, chance = self._bounce(sampler, ray, ng, ns, front, material, hit)
            weight = weight * factor
            share = share * chance
            goes_on = hit & (depth < self._depth) & (dr.max(weight) * share > self._e.cutoff)
            following = there.spawn_ray(direction)
            return radiance, following, weight, share, goes_on

        def _nearest(self, ray: Any, coherent: Any, active: Any) -> Any:
            """Distance, point, both normals, side and material of what each ray hits first."""
            t, uv = mi.Float(math.inf), mi.Point2f(0)
            triangle, gone = mi.UInt32(0), mi.Vector3f(0)
            for scene, part, first in zip(self._scenes, self._e.parts, self._first, strict=False):
                own = mi.Ray3f(ray)
                moved = mi.Vector3f(part.velocity) * ray.time
                own.o -= moved
                own.maxt = dr.minimum(ray.maxt, t)
                found = scene.ray_intersect_preliminary(own, coherent=coherent, active=active)
                nearer = found.is_valid() & active
                t = dr.select(nearer, found.t, t)
                uv = dr.select(nearer, found.prim_uv, uv)
                triangle = dr.select(nearer, found.prim_index + first, triangle)
                if any(part.velocity):
                    gone = dr.select(nearer, moved, gone)
            hit = active & (t < math.inf)
            face = dr.gather(mi.Vector3u, self._faces, triangle, hit)
            corner = [dr.gather(mi.Point3f, self._vertices, i, hit) for i in face]
            normal = [dr.gather(mi.Vector3f, self._normals, i, hit) for i in face]
            edge_1, edge_2 = corner[1] - corner[0], corner[2] - corner[0]
            p = corner[0] + edge_1 * uv.x + edge_2 * uv.y + gone
            ng = dr.normalize(dr.cross(edge_1, edge_2))
            ns = dr.normalize(normal[0] * (1 - uv.x - uv.y) + normal[1] * uv.x + normal[2] * uv.y)
            front = dr.dot(ng, ray.d) < 0
            ng, ns = dr.select(front, ng, -ng), dr.select(front, ns, -ns)
            return t, p, ng, ns, front, dr.gather(mi.UInt32, self._material, triangle, hit)

        def _background(self, direction: Any, active: Any) -> Any:
            """What rays see that hit nothing: a constant, or the cube's texels in between."""
            if not self._e.cube.size:
                return mi.Color3f(self._e.background)
            face, s, t = _on_cube(direction)
            row_length = self._e.cube.shape[1]
            inner = row_length - 2
            # In texels of the bordered face, whole numbers at their centres.
            column = (0.5 * s + 0.5) * inner + 0.5
            row = (0.5 * t + 0.5) * inner + 0.5
            i, j = mi.UInt32(column), mi.UInt32(row)
            a, b = column - i, row - j
            first = (face * row_length + j) * row_length + i

            def texel(offset: int) -> Any:
                return dr.gather(mi.Color3f, self._cube, first + offset, active)

            return dr.lerp(
                dr.lerp(texel(0), texel(1), a),
                dr.lerp(texel(row_length), texel(row_length + 1), a),
                b,
            )

        def _direct(
            self,
            light: dict[str, Any],
            sampler: Any,
            ray: Any,
            there: Any,
            ns: Any,
            material: Any,
            hit: Any,
        ) -> Any:
            """Reflected light of one lamp, from one point on it."""
            if light["type"] == "directional":
                towards = mi.Vector3f(light["towards"])
                irradiance = mi.Color3f(light["irradiance"])
                shadow = there.spawn_ray(towards)
            else:
                point = mi.Point3f(light["center"])
                if light["type"] == "sphere":
                    u = sampler.next_2d(hit)
                    point += light["radius"] * mi.warp.square_to_uniform_sphere(u)
                towards = point - there.p
                squared = dr.squared_norm(towards)
                towards *= dr.rsqrt(squared)
                irradiance = mi.Color3f(light["intensity"]) / squared
                shadow = there.spawn_ray_to(point)
            cosine = dr.dot(ns, towards)
            reflected = self._row("diffuse", material, hit)
            if self._rows_used("specular"):
                half = dr.normalize(towards - ray.d)
                power = self._row("exponent", material, hit)
                highlight = dr.power(dr.maximum(dr.dot(half, ns), 1e-6), power)
                reflected += self._row("specular", material, hit) * highlight
            asks = hit & (cosine > 0) & (dr.max(reflected) > 0)
            asks &= ~self._blocked(shadow, there.time, asks)
            return dr.select(asks, reflected * irradiance * (cosine / math.pi), 0)

        def _sky(self, sampler: Any, there: Any, ns: Any, material: Any, hit: Any) -> Any:
            """Reflected light of the environment, from one direction with the density of the cosine.

            Mitsuba can also draw directions where its `envmap` is bright, and weigh both ways; for the cube map's
            clay that halves the error's square at one and a half times the cost of the whole picture: no gain.
            """
            diffuse = self._row("diffuse", material, hit)
            local = mi.warp.square_to_cosine_hemisphere(sampler.next_2d(hit))
            towards = mi.Frame3f(ns).to_world(local)
            asks = hit & (dr.max(diffuse) > 0) & (dr.dot(towards, there.n) > 0)
            asks &= ~self._blocked(there.spawn_ray(towards), there.time, asks)
            return dr.select(asks, diffuse * self._background(towards, asks), 0)

        def _blocked(self, shadow: Any, time: Any, asks: Any) -> Any:
            blocked = mi.Bool(False)
            for scene, part in zip(self._scenes, self._e.parts, strict=True):
                own = mi.Ray3f(shadow)
                own.o -= mi.Vector3f(part.velocity) * time
                blocked |= scene.ray_test(own, coherent=False, active=asks & ~blocked)
            return blocked

        def _bounce(
            self, sampler: Any, ray: Any, ng: Any, ns: Any, front: Any, material: Any, hit: Any
        ) -> Any:
            """Direction of the ray that goes on, its weight, and the probability of this way."""
            mirrored = ray.d - 2 * dr.dot(ray.d, ns) * ns
            mirrored = _kept(mirrored, ng)
            mirrored = self._blurred(sampler, mirrored, ng, material, hit)
            weight, chance = self._row("mirror", material, hit), mi.Float(1)
            if not self._rows_used("refraction_index"):
                return mirrored, weight, chance
            index = self._row("refraction_index", material, hit)
            glass = index > 0
            cosine = dr.clip(-dr.dot(ray.d, ns), 0, 1)
            share, cos_t, _, eta = mi.fresnel(dr.select(front, cosine, -cosine), index)
            reflects = sampler.next_1d(hit) < share
            refracted = ray.d * eta + ns * (eta * cosine - dr.abs(cos_t))
            refracted = -_kept(-refracted, ng)
            weight = dr.select(glass, mi.Color3f(1), weight)
            chance = dr.select(glass, dr.select(reflects, share, 1 - share), chance)
            return dr.select(glass & ~reflects, refracted, mirrored), weight, chance

        def _blurred(self, sampler: Any, axis: Any, ng: Any, material: Any, hit: Any) -> Any:
            """Mirrored directions, moved by the lobes of glossy materials."""
            kinds = {LOBES[int(lobe)] for lobe in self._e.materials.lobe} - {""}
            if not kinds:
                return axis
            lobe = dr.gather(mi.UInt32, self._lobe, material, hit)
            parameter = self._row("parameter", material, hit)
            u = sampler.next_2d(hit)
            phi = 2 * math.pi * u.y
            result = axis
            if "jitter_on_plane" in kinds:
                a, b = parameter * (u.x - 0.5), parameter * (u.y - 0.5)
                moved = _in_basis(axis, dr.normalize(mi.Vector3f(a, b, 1)))
                result = dr.select(lobe == LOBES.index("jitter_on_plane"), moved, result)
            if "jitter_in_ball" in kinds:
                radius = parameter * dr.cbrt(sampler.next_1d(hit))
                ring = radius * 2 * dr.sqrt(u.x * (1 - u.x))
                sin, cos = dr.sincos(phi)
                inside = mi.Vector3f(ring * cos, ring * sin, radius * (1 - 2 * u.x))
                moved = dr.normalize(axis + inside)
                result = dr.select(lobe == LOBES.index("jitter_in_ball"), moved, result)
            if "sample_phong_lobe" in kinds:
                log_cos = dr.log(1 - u.x) / (parameter + 1)
                height = dr.exp(log_cos)
                ring = dr.safe_sqrt(1 - height * height)
                sin, cos = dr.sincos(phi)
                moved = _in_basis(axis, mi.Vector3f(ring * cos, ring * sin, height))
                result = dr.select(lobe == LOBES.index("sample_phong_lobe"), moved, result)
            return dr.select(lobe > 0, _kept(result, ng), axis)

        def _rows_used(self, name: str) -> bool:
            return bool(getattr(self._e.materials, name).any())

        def _row(self, name: str, material: Any, hit: Any) -> Any:
            """A property of the materials that were hit: a colour or a number."""
            kind = mi.Color3f if getattr(self._e.materials, name).ndim == 2 else mi.Float
            return dr.gather(kind, self._rows[name], material, hit)

    def _kept(direction: Any, ng: Any) -> Any:
        """Directions that point below the surface, mirrored out of it."""
        return direction - 2 * dr.minimum(dr.dot(direction, ng), 0) * ng

    def _in_basis(w: Any, local: Any) -> Any:
        """A local direction in the orthonormal basis of Duff et al. about w."""
        sign = dr.copysign(mi.Float(1), w.z)
        a = -1 / (sign + w.z)
        b = w.x * w.y * a
        u = mi.Vector3f(1 + sign * w.x * w.x * a, sign * b, -sign * w.x)
        v = mi.Vector3f(b, sign + w.y * w.y * a, -w.y)
        return u * local.x + v * local.y + w * local.z

    def _on_cube(direction: Any) -> Any:
        """Face 0..5 and place (s, t) in [-1, 1] where a direction leaves the cube: OpenGL's table."""
        x, y, z = direction
        size = dr.abs(direction)
        is_x = (size.x >= size.y) & (size.x >= size.z)
        is_y = ~is_x & (size.y >= size.z)
        m = dr.select(is_x, x, dr.select(is_y, y, z))
        inverse = dr.rcp(dr.abs(m))
        s = dr.select(is_x, -dr.mulsign(z, m), dr.select(is_y, x, dr.mulsign(x, m))) * inverse
        t = dr.select(is_y, dr.mulsign(z, m), -y) * inverse
        face = dr.select(is_x, mi.UInt32(0), dr.select(is_y, mi.UInt32(2), mi.UInt32(4)))
        return face + dr.select(m < 0, mi.UInt32(1), mi.UInt32(0)), s, t

    def _floats(arrays: list[np.ndarray]) -> Any:
        return mi.Float(np.concatenate([np.ravel(a) for a in arrays]).astype(np.float32))

    def _integers(arrays: list[np.ndarray]) -> Any:
        return mi.UInt32(np.concatenate([np.ravel(a) for a in arrays]).astype(np.uint32))

    return DistributionIntegrator
