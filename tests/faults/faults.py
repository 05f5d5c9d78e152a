# SPDX-License-Identifier: Apache-2.0
# Faults of one line that a hand or a merge may put into a kernel. run.py puts in one at a time and asks which tests notice.
# A fault: its name, the file in kernels/, the text that is there exactly once, and what stands there instead.
from typing import NamedTuple


class Fault(NamedTuple):
    name: str
    file: str
    right: str
    wrong: str


FAULTS = [
    # Optics
    Fault("r_p has a plus", "fresnel.h", "(n_t * cos_i - n_i * cos_t) /", "(n_t * cos_i + n_i * cos_t) /"),
    Fault("only half of the polarisations", "fresnel.h", "0.5f * (s * s + p * p)", "s * s"),
    Fault("eta is upside down", "surface.h", "const float eta = n_i / n_t;", "const float eta = n_t / n_i;"),
    Fault("refracts to the wrong side", "fresnel.h", "(eta * cos_i - cos_t) * normal", "(eta * cos_i + cos_t) * normal"),
    Fault("mirror reflects half as far", "fresnel.h", "direction + 2.0f * cos_i * normal", "direction + cos_i * normal"),
    Fault("n^2 the other way round", "interface.h", "*n_ratio = n_i / n_t;", "*n_ratio = n_t / n_i;"),
    Fault("radiance without n^2", "eye_path.h", "radiance_scale *= n_ratio * n_ratio;", "radiance_scale *= n_ratio;"),
    Fault("absorbs half", "world.h", "(path->behind + distance) * world->scene.metres_per_unit",
          "0.5f * (path->behind + distance) * world->scene.metres_per_unit"),
    Fault("absorption in units, not metres", "world.h", "(path->behind + distance) * world->scene.metres_per_unit", "(path->behind + distance)"),
    Fault("a medium is never left", "interface.h", "leave_medium(&beyond, surface->object);", ";"),
    Fault("leaves the medium of lowest priority", "media.h", "priority >= best_priority", "priority <= best_priority"),
    # Emission
    Fault("overlapping targets count twice", "emission.h", "return 2.0f * PI_F * sum / (float)count;", "return 2.0f * PI_F * sum;"),
    Fault("overlapping discs count twice", "emission.h", "light->radiometric * square_metres / (float)count", "light->radiometric * square_metres"),
    Fault("never the last target", "emission.h", "while (chosen + 1 < target_count && rest >=", "while (chosen + 2 < target_count && rest >="),
    Fault("area light without its cosine", "emission.h", "light->radiometric * cosine / PI_F * steradians", "light->radiometric / PI_F * steradians"),
    Fault("area light shines backwards", "emission.h", "cosine > 0.0f ? light->radiometric * cosine", "cosine < 0.0f ? -light->radiometric * cosine"),
    Fault("disc not uniform", "emission.h", "w * sqrt(random.y)", "w * random.y"),
    Fault("cone not uniform", "emission.h", "*below = u * one_minus_cos;", "*below = u * u * one_minus_cos;"),
    Fault("half of the rectangle", "light.h", "(place.y - 0.5f) * light->edge_v", "place.y * light->edge_v"),
    Fault("spot's solid angle forgotten", "emission.h", "emission.watts = light->radiometric * steradians / light->solid_angle;",
          "emission.watts = light->radiometric * steradians / (4.0f * PI_F);"),
    # Random numbers
    Fault("place and direction from one block", "photon_path.h", "random4(seed, pass, photon, 1u, STREAM_PHOTONS)",
          "random4(seed, pass, photon, 0u, STREAM_PHOTONS)"),
    Fault("choices from the block of emission", "photon_path.h", "2u + (uint)surface_number / 4u", "(uint)surface_number / 4u"),
    Fault("every pass alike", "photon_path.h", "random4(seed, pass, photon, 0u, STREAM_PHOTONS)", "random4(seed, 0u, photon, 0u, STREAM_PHOTONS)"),
    Fault("one choice for four surfaces", "photon_path.h", "choices = choices.yzwx;", ";"),
    Fault("nine rounds of Philox", "random.h", "round < 10", "round < 9"),
    # Film, camera and direct light
    Fault("splats a pixel to the right", "splat.h", "(int)place.y * camera->width + (int)place.x",
          "(int)place.y * camera->width + min((int)place.x + 1, camera->width - 1)"),
    Fault("splat without the surface's cosine", "splat.h", "*weight = fabs(cos_camera) /", "*weight = length(to_camera) /"),
    Fault("splat without 1/pi", "photons.cl", "strand.xyz * (watts * splat.weight / PI_F)", "strand.xyz * (watts * splat.weight)"),
    Fault("film writes X for Y", "film.h", "convert_long_rte(quanta.y + shift)", "convert_long_rte(quanta.x + shift)"),
    Fault("both halves in one image", "film.h", "(pass % NEPHROID_FILM_HALVES)", "(pass % 1)"),
    Fault("photons of the cluster before", "photons.cl", "choose_band(&world, emitter.light, emitter.cluster,",
          "choose_band(&world, emitter.light, max(emitter.cluster - 1, 0),"),
    Fault("eye's cluster before", "camera.h", "return choose(cdf + 1, count, golden_place(seed, frame, path, paths, pixel, stream));",
          "return max(choose(cdf + 1, count, golden_place(seed, frame, path, paths, pixel, stream)) - 1, 0);"),
    Fault("eye's cluster without its probability", "direct.cl", "(cluster_cdf[cluster + 1] - cluster_cdf[cluster])", "(1.0f / (float)scene.cluster_count)"),
    Fault("no jitter down the pixel", "camera.h", "((float)row + jitter.y)", "((float)row + 0.5f)"),
    Fault("direct light without the cosine", "eye_path.h", "light->radiometric * max(dot(arrival.direction, normal), 0.0f)", "light->radiometric"),
    Fault("falls with the distance, not its square", "eye_path.h", "cosine / (metres * metres)", "cosine / metres"),
    # Geometry
    Fault("edges leak", "bvh.h", "(low >= 0.0f) | (high <= 0.0f)", "(low > 1e-4f) | (high < -1e-4f)"),
    Fault("boxes do not grow", "bvh.h", "0x1p-20f * BVH_MAX", "-0x1p-12f * BVH_MAX"),
    Fault("barycentrics swapped", "surface.h", "a + hit.u * ab + hit.v * ac", "a + hit.v * ab + hit.u * ac"),
    Fault("faceted where smooth", "surface.h", "if (objects[surface.object].smooth)", "if (!objects[surface.object].smooth)"),
    # Indirect light
    Fault("light of the first diffuse surface too", "indirect.cl", "bool met_diffuse = false;", "bool met_diffuse = true;"),
    Fault("sent on uniformly, not by the cosine", "indirect.cl", "const float radius = sqrt(u);", "const float radius = sqrt(u * (2.0f - u));"),
    Fault("reflectance counts twice", "indirect.cl", "const float scale = photon->watts *",
          "const float scale = world->tables.reflectance[reflector * WAVELENGTH_COUNT + photon->band.wavelength] * photon->watts *"),
    Fault("indirect light without the shading normal", "indirect.cl", "photon->shading *= shading_ratio(&surface, path->direction);", ";"),
    Fault("splats without the shading normal", "splat.h", "splat.weight *= shading_ratio(surface, arriving);", ";"),
    Fault("stored photons without the shading normal", "photons.cl", "(watts * shading_ratio(&end.surface, path.direction))", "watts"),
    Fault("the shading normal's ratio upside down", "surface.h", "dot(arriving, surface->shading) / dot(arriving, surface->geometric);",
          "dot(arriving, surface->geometric) / dot(arriving, surface->shading);"),
    # Background
    Fault("surroundings as in a mirror", "background.h", "atan2(direction.x, -direction.z)", "atan2(-direction.x, -direction.z)"),
    Fault("surroundings upside down", "background.h", "direction.z * direction.z), direction.y)", "direction.z * direction.z), -direction.y)"),
    Fault("turned the other way", "background.h", "+ b->size.turns", "- b->size.turns"),
    Fault("half a texel to the side", "background.h", "(float)b->size.width - 0.5f", "(float)b->size.width"),
    Fault("a seam", "background.h", "column + 1 < b->size.width ? column + 1 : 0", "min(column + 1, b->size.width - 1)"),
    Fault("background without n^2", "background.cl", "return radiance_scale * shown_after(", "return shown_after("),
    Fault("wavelengths without their weight", "background.cl", "* band->weight * background_xyz", "* background_xyz"),
    # One wavelength of a cluster, low-discrepancy sequences, photons sent where they matter
    Fault("one wavelength without its chance", "band.h", "1.0f / (cdf[member] - before)", "(float)count"),
    Fault("the cluster's first wavelength always", "band.h", "const int member = choose(cdf, count, u);", "const int member = 0;"),
    Fault("a wrong direction number", "low_discrepancy.h", "(uint3)(0xf0000000u, 0x90000000u, 0x50000000u)",
          "(uint3)(0xe0000000u, 0x90000000u, 0x50000000u)"),
    Fault("the same key for every sequence", "low_discrepancy.h", "(uint4)(sequence, set << 16 | STREAM_SOBOL)", "(uint4)((uint3)(0u), STREAM_SOBOL)"),
    Fault("a sequence starts over with each pass", "photon_path.h", "(ulong)((pass - first_pass) / NEPHROID_FILM_HALVES)", "(ulong)0"),
    Fault("both halves follow one sequence", "photon_path.h", "<< 1 | pass % NEPHROID_FILM_HALVES", "<< 1"),
    Fault("both halves choose the same clusters", "camera.h", "half_of_frames = frame & 1u", "half_of_frames = 0u"),
    Fault("place and direction from one set", "photon_path.h", "sobol4(seed, sequence, 1u, index)", "sobol4(seed, sequence, 0u, index)"),
    Fault("an area light's diagonal", "photon_path.h", "sobol4(seed, sequence, 1u, index).xy", "sobol4(seed, sequence, 1u, index).xx"),
    Fault("guided photons without their chance", "guide.h", "*density *= chance * (float)count;", ";"),
    Fault("guided to the bin before", "guide.h", "const float moved = ((float)bin +", "const float moved = (max((float)bin - 1.0f, 0.0f) +"),
    # Photon maps
    Fault("gathers from a ball, not a flat spheroid", "photon_map.h", "g.tilt = 4.0f * normal;", "g.tilt = 0.0f * normal;"),
    Fault("one row of cells too few", "photon_map.h", "k <= rows_z", "k < rows_z"),
    Fault("the last photon of a bucket is lost", "grid.cl", "grid.bucket_mask)) - 1u;", "grid.bucket_mask));"),
    Fault("map without the path's throughput", "gather.cl", "* point.throughput.xyz;", ";"),
    Fault("a sheet has one side", "photon_map.h", "* 2 + (front ? 1 : 0)", "* 2"),
    Fault("the eye's wavelength is of another pass", "view.cl", "band_of_pass(&world, cluster, part, seed, pass)",
          "band_of_pass(&world, cluster, part, seed, pass + 1u)"),
    Fault("each of a pixel's paths counts in full", "view.cl", "float weight = 1.0f / (float)path_count;", "float weight = 1.0f;"),
    Fault("view's cluster without its probability", "view.cl", "(cluster_cdf[cluster + 1] - cluster_cdf[cluster])", "(1.0f / (float)scene.cluster_count)"),
    Fault("flux does not shrink with its radius", "gather.cl", "(pixel.flux[1] + flux.y) * shrink", "(pixel.flux[1] + flux.y)"),
    Fault("view without a mirror's losses", "view.cl", "if (!losses->any) return part;", "return part;"),
    # Spectral differentials
    Fault("transfer without the surface's tilt", "differential.h", "moved - dot(moved, geometric) / dot(direction, geometric) * direction", "moved"),
    Fault("dispersion at the surface forgotten", "differential.h", "return d_eta * direction + eta * d_direction", "return eta * d_direction"),
    Fault("streak the other way", "stretch.h", "path->direction + x * path->differential.direction", "path->direction - x * path->differential.direction"),
    Fault("every strand has all the light", "stretch.h", "strand->xyz /= (float)stretch->count;", ";"),
    # Relighting
    Fault("layer of the cluster before", "relight_photons.cl", "emitter.light * scene.cluster_count + emitter.cluster;",
          "emitter.light * scene.cluster_count + max(emitter.cluster - 1, 0);"),
    Fault("layers of eye paths four times as bright", "relight_direct.cl", " * (float)PATHS_THROUGH_GLASS);", ");"),
    Fault("green weighed as red", "relight_weigh.cl", "b += weight[1] * value;", "b += weight[0] * value;"),
    Fault("only a pixel's first cell", "relight_weigh.cl", "i < first[pixel + 1]; ++i", "i < min(first[pixel] + 1, first[pixel + 1]); ++i"),
]
