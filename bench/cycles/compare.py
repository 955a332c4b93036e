"""Compares what Lambert solved with what render.py path-traced, patch by patch.

    python3 compare.py BAKED_DIR TRACED_DIR [PICTURE.jpg]

Prints one JSON object. Compared is the reflected luminance, (B - E) / pi of patches.csv against the
rendering without the emission of the patch, as the mean of the three channels. A patch has the mean of its
pixels, by the area that each shows of it; the renderings see it at other points each, and only pixels count
in which a rendering saw one patch alone. Only patches are compared that are in view whole: what is hidden
of one may be darker. Black ones are left out: they reflect nothing, and what a rendering shows there is the light of
another surface in the same plane. PICTURE.jpg shows both side by side under the exposure of run.json, and filmic: Lambert
on the left.

Needs python3-numpy, python3-openimageio and python3-pil.
"""

import csv
import glob
import json
import math
import os
import struct
import sys

import numpy
import OpenImageIO
from PIL import Image

SEEN_WHOLE = 0.95  # of a patch's pixels: the rest is rounding at its edges


def read_exr(path):
    """Pixels [height, width] by the name of the channel, without the name of a view layer."""
    image = OpenImageIO.ImageInput.open(path)
    spec = image.spec()
    pixels = image.read_image(0, 0, 0, spec.nchannels, "float")
    names = [name.removeprefix("ViewLayer.") for name in spec.channelnames]
    return {name: pixels[:, :, k] for k, name in enumerate(names)}


def colour(layers, prefix=""):
    return numpy.stack([layers[prefix + c] for c in "RGB"], axis=2).astype(float)


def read_table(folder, names):
    """Columns NAME_r, _g, _b of patches.csv: [n, 3] by name."""
    with open(os.path.join(folder, "patches.csv"), newline="") as file:
        rows = csv.reader(file)
        column = {name: at for at, name in enumerate(next(rows))}
        at = [[column[f"{name}_{c}"] for c in "rgb"] for name in names]
        values = [[[float(row[k]) for k in triple] for triple in at] for row in rows]
    return dict(zip(names, numpy.array(values).swapaxes(0, 1)))


class View:
    """The camera of NAME.glb, and the triangles of patches.csv in it."""

    def __init__(self, folder, name, corners, height, width):
        with open(os.path.join(folder, name + ".glb"), "rb") as file:
            gltf = json.loads(file.read(struct.unpack("<5I", file.read(20))[3]))
        node = next(node for node in gltf["nodes"] if "camera" in node)
        camera = gltf["cameras"][node["camera"]]
        matrix = numpy.array(node["matrix"]).reshape(4, 4)
        self.axes, eye = matrix[:3, :3], matrix[3, :3]  # right, up, back
        self.size = numpy.array([width, height])
        self.is_flat = camera["type"] != "perspective"
        if self.is_flat:
            self.half = numpy.array([camera["orthographic"][k] for k in ("xmag", "ymag")])
        else:
            tangent = math.tan(camera["perspective"]["yfov"] / 2)
            self.half = tangent * numpy.array([camera["perspective"]["aspectRatio"], 1])
        self.corners = (corners - eye) @ self.axes.T
        self.normals = numpy.cross(self.corners[:, 1] - self.corners[:, 0],
                                   self.corners[:, 2] - self.corners[:, 0])

    def areas(self):
        """Of each triangle in pixels; infinite where a corner is out of view."""
        depth = 1 if self.is_flat else -self.corners[:, :, 2:]
        at = self.corners[:, :, :2] / numpy.where(depth == 0, 1e-30, depth) / self.half
        inside = (abs(at) <= 1).all(axis=(1, 2)) & (self.corners[:, :, 2] < 0).all(axis=1)
        a, b = at[:, 1] - at[:, 0], at[:, 2] - at[:, 0]
        pixels = abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2 * self.size.prod() / 4
        return numpy.where(inside, pixels, math.inf)

    def weights(self, patch):
        """Area that each pixel shows of its patch, in any unit: 1 / cos^3 to the plane's normal."""
        if self.is_flat:
            return numpy.ones(patch.shape)
        width, height = self.size
        x = self.half[0] * ((2 * numpy.arange(width) + 1) / width - 1)
        y = self.half[1] * (1 - (2 * numpy.arange(height) + 1) / height)
        normal = self.normals[numpy.maximum(patch, 0)]
        along = normal[:, :, 0] * x + normal[:, :, 1] * y[:, None] - normal[:, :, 2]
        return numpy.where(patch >= 0, 1 / numpy.maximum(abs(along), 1e-30) ** 3, 0)


def read_corners(folder):
    with open(os.path.join(folder, "patches.csv"), newline="") as file:
        rows = csv.reader(file)
        first = next(rows).index("x0")
        return numpy.array([row[first:first + 9] for row in rows], float).reshape(-1, 3, 3)


def filmic(value):
    """Khronos PBR neutral without its Fresnel term, as radiosity/output/exposure.cc."""
    peak = value.max(axis=2, keepdims=True)
    new_peak = 1 - 0.04 / numpy.maximum(peak - 0.6, 0.2)
    white = 1 - 1 / (0.15 * numpy.maximum(peak - new_peak, 0) + 1)
    rolled = value * new_peak / numpy.maximum(peak, 1e-30) * (1 - white) + new_peak * white
    return numpy.where(peak > 0.8, rolled, value)


def to_picture(luminance, exposure):
    display = numpy.clip(filmic(luminance * math.pi * exposure), 0, 1)
    encoded = numpy.where(display <= 0.0031308, 12.92 * display,
                          1.055 * numpy.maximum(display, 1e-9) ** (1 / 2.4) - 0.055)
    return Image.fromarray(numpy.round(255 * encoded).astype(numpy.uint8))


def patch_numbers(traced):
    """Of every pixel, -1 where there is none or where samples saw several."""
    digits = colour(traced, "patch.")
    whole = numpy.abs(digits - numpy.round(digits)).max(axis=2) < 1e-3
    number = numpy.round(digits) @ numpy.array([1, 256, 65536]) - 1
    return numpy.where(whole, number, -1).astype(int)


def share_confirmed(patch, baked_id):
    """Of the pixels with a patch, those where one of the four of the EXR around has the same."""
    height, width = patch.shape
    four = [baked_id[y:2 * height:2, x:2 * width:2] for y in (0, 1) for x in (0, 1)]
    same = numpy.any([quarter == patch for quarter in four], axis=0)
    return float(same[patch >= 0].mean())


def main():
    folder, traced_folder = sys.argv[1:3]
    run = json.load(open(os.path.join(folder, "run.json")))
    table = read_table(folder, ["reflectance", "exitance", "radiosity", "std_error"])
    paths = sorted(glob.glob(os.path.join(traced_folder, "seed_*.exr")))
    seeds = [read_exr(path) for path in paths]
    baked = read_exr(os.path.join(folder, run["name"] + ".exr"))
    ours = (table["radiosity"] - table["exitance"]).mean(axis=1) / math.pi
    # Channels of one ray go together. Negative: not known.
    ours_error = numpy.maximum(table["std_error"].mean(axis=1), 0) / math.pi

    count, size = len(seeds), len(ours)
    pixels = numpy.zeros(size)
    weights = numpy.zeros((count, size))
    totals = numpy.zeros((count, size))  # reflected luminance of the patches, mean of the channels
    height, width = (side // 2 for side in baked["id.patch"].shape)
    view = View(folder, run["name"], read_corners(folder), height, width)
    for k, traced in enumerate(seeds):
        patch = patch_numbers(traced)
        members, weight = patch[patch >= 0], view.weights(patch)[patch >= 0]
        reflected = (colour(traced, "Combined.")[patch >= 0]
                     - table["exitance"][members] / math.pi).mean(axis=1)
        pixels += numpy.bincount(members, minlength=size) / count
        weights[k] = numpy.bincount(members, weights=weight, minlength=size)
        totals[k] = numpy.bincount(members, weights=weight * reflected, minlength=size)
    all_weights = numpy.maximum(weights.sum(axis=0), 1e-300)
    truth = totals.sum(axis=0) / all_weights
    # Of a ratio of sums over renderings, each of which sees a patch at other points.
    rest = (totals - truth * weights) / all_weights * math.sqrt(count / (count - 1))
    truth_error = numpy.sqrt((rest ** 2).sum(axis=0))
    whole = (pixels > 0) & (pixels >= SEEN_WHOLE * view.areas()) & (table["reflectance"].max(axis=1) > 0)
    share = numpy.where(whole, pixels, 0) / max(pixels[whole].sum(), 1e-300)
    mean_truth = (share * truth).sum()
    mean_excess = (share * ours).sum() - mean_truth
    excess_error = math.sqrt(((rest @ share) ** 2).sum() + ((ours_error * share) ** 2).sum())

    # Patches of 20 pixels and more, and of those whose error is known.
    judged = whole & (pixels >= 20) & (table["std_error"].min(axis=1) >= 0)
    known = judged & (truth_error > 0)
    z = (ours - truth)[known] / numpy.hypot(ours_error, truth_error)[known]
    relative = numpy.abs(ours - truth)[judged] / numpy.maximum(truth[judged], 0.01 * mean_truth)
    result = {
        "name": run["name"],
        "patches": size,
        "patches_seen": int((pixels > 0).sum()),
        "pixels": int(pixels.sum()),
        "pixels_of_whole_patches": pixels[whole].sum() / max(pixels.sum(), 1),
        "pixels_confirmed": share_confirmed(patch_numbers(seeds[0]), baked["id.patch"]),
        "seeds": count,
        "mean_lambert_cd_per_m2": mean_truth + mean_excess,
        "mean_cycles_cd_per_m2": mean_truth,
        "mean_difference": mean_excess / mean_truth if mean_truth > 0 else None,
        "mean_difference_se": excess_error / mean_truth if mean_truth > 0 else None,
        "patches_judged": int(judged.sum()),
    }
    if len(z) > 0:
        result |= {
            "z_median": float(numpy.median(z)),
            "z_within_2": float((numpy.abs(z) < 2).mean()),
            "z_within_3": float((numpy.abs(z) < 3).mean()),
            "relative_median": float(numpy.median(relative)),
            "relative_p95": float(numpy.percentile(relative, 95)),
            "relative_se_median": float(numpy.median(
                (numpy.hypot(ours_error, truth_error) / numpy.maximum(truth, 1e-30))[known])),
        }
    print(json.dumps(result, indent=1))
    if len(sys.argv) > 3:
        exposure = run["picture"]["exposure_per_lm_per_m2"]
        left = colour(baked)[:2 * height, :2 * width].reshape(height, 2, width, 2, 3).mean(axis=(1, 3))
        right = numpy.mean([colour(traced, "Combined.") for traced in seeds], axis=0)
        both = Image.new("RGB", (2 * width + 4, height), (255, 255, 255))
        both.paste(to_picture(left, exposure), (0, 0))
        both.paste(to_picture(right, exposure), (width + 4, 0))
        both.save(sys.argv[3], quality=85, optimize=True)


if __name__ == "__main__":
    main()
