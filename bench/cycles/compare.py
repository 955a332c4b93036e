"""Compares what Lambert solved with what render.py path-traced, patch by patch.

    python3 compare.py BAKED_DIR TRACED_DIR [PICTURE.jpg]

Prints one JSON object. Compared is the reflected luminance, (B - E) / pi of patches.csv against the
rendering without the emission of the patch, as the mean of the three channels; a patch has the mean of
its pixels, and only pixels count in which the rendering saw one patch alone. PICTURE.jpg shows both
side by side under the exposure of run.json, and filmic: Lambert on the left.

Needs python3-numpy, python3-openimageio and python3-pil.
"""

import csv
import glob
import json
import math
import os
import sys

import numpy
import OpenImageIO
from PIL import Image


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
    table = read_table(folder, ["exitance", "radiosity", "std_error"])
    seeds = [read_exr(path) for path in sorted(glob.glob(os.path.join(traced_folder, "seed_*.exr")))]
    baked = read_exr(os.path.join(folder, run["name"] + ".exr"))
    patch = patch_numbers(seeds[0])
    for traced in seeds[1:]:
        patch = numpy.where(patch_numbers(traced) == patch, patch, -1)

    seen = patch >= 0
    members = patch[seen]
    pixels = numpy.bincount(members, minlength=len(table["exitance"]))
    emitted = table["exitance"] / math.pi
    by_seed = []  # reflected luminance of the patches, mean of the channels
    for traced in seeds:
        reflected = (colour(traced, "Combined.")[seen] - emitted[members]).mean(axis=1)
        total = numpy.bincount(members, weights=reflected, minlength=len(pixels))
        by_seed.append(total / numpy.maximum(pixels, 1))
    by_seed = numpy.array(by_seed)
    count = len(seeds)

    ours = (table["radiosity"] - table["exitance"]).mean(axis=1) / math.pi
    ours_error = table["std_error"].mean(axis=1) / math.pi  # channels of one ray go together
    truth = by_seed.mean(axis=0)
    truth_error = by_seed.std(axis=0, ddof=1) / math.sqrt(count)
    mean_by_seed = (by_seed * pixels).sum(axis=1) / pixels.sum()
    mean_truth = mean_by_seed.mean()
    mean_ours = (ours * pixels).sum() / pixels.sum()
    ours_mean_error = math.sqrt(((ours_error * pixels) ** 2).sum()) / pixels.sum()

    # Patches of 20 pixels and more, and of those whose error is known.
    judged = (pixels >= 20) & (table["std_error"].min(axis=1) >= 0)
    known = judged & (truth_error > 0)
    z = (ours - truth)[known] / numpy.hypot(ours_error, truth_error)[known]
    relative = numpy.abs(ours - truth)[judged] / numpy.maximum(truth[judged], 0.01 * mean_truth)
    result = {
        "name": run["name"],
        "patches": len(pixels),
        "patches_seen": int((pixels > 0).sum()),
        "pixels": int(pixels.sum()),
        "pixels_confirmed": share_confirmed(patch, baked["id.patch"]),
        "seeds": count,
        "mean_lambert_cd_per_m2": mean_ours,
        "mean_cycles_cd_per_m2": mean_truth,
        "mean_difference": mean_ours / mean_truth - 1 if mean_truth > 0 else None,
        "mean_difference_se": float(numpy.hypot(mean_by_seed.std(ddof=1) / math.sqrt(count),
                                                ours_mean_error) / mean_truth)
        if mean_truth > 0 else None,
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
        height, width = patch.shape
        left = colour(baked)[:2 * height, :2 * width].reshape(height, 2, width, 2, 3).mean(axis=(1, 3))
        right = numpy.mean([colour(traced, "Combined.") for traced in seeds], axis=0)
        both = Image.new("RGB", (2 * width + 4, height), (255, 255, 255))
        both.paste(to_picture(left, exposure), (0, 0))
        both.paste(to_picture(right, exposure), (width + 4, 0))
        both.save(sys.argv[3], quality=85, optimize=True)


main()
