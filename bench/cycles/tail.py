"""What Cycles leaves out of a scene whose light bounces more than 1024 times.

    python3 tail.py BAKED_DIR HALF_DIR TRACED_DIR

HALF_DIR and TRACED_DIR hold renderings of render.py of the same seeds, with BOUNCES=512 and with 1024. After so
many bounces light falls by the same share in each, so with r the reflected light of 1024 bounces over that of 512 the
1024 hold 1 - (r - 1)^2 of all of it. Prints that share, its standard error over the renderings, and the number of bounces in
which light falls to 1/e.
"""

import math
import os
import sys

import numpy

from compare import colour, patch_numbers, read_exr, read_table


def main():
    baked, half, whole = sys.argv[1:4]
    dark = read_table(baked, ["exitance"])["exitance"].max(axis=1) == 0
    sums = []
    for name in sorted(os.listdir(half)):
        renderings = [read_exr(os.path.join(folder, name)) for folder in (half, whole)]
        patch = patch_numbers(renderings[1])
        reflects = (patch >= 0) & dark[patch]
        sums.append([colour(traced, "Combined.")[reflects].sum() for traced in renderings])
    sums = numpy.array(sums)
    ratio = sums[:, 1].sum() / sums[:, 0].sum()
    spread = (sums[:, 1] - ratio * sums[:, 0]) / sums[:, 0].sum() * math.sqrt(len(sums) / (len(sums) - 1))
    error = 2 * (ratio - 1) * math.sqrt((spread ** 2).sum())
    print(f"share {1 - (ratio - 1) ** 2:.5f} +- {error:.5f}, 1/e in {-512 / math.log(ratio - 1):.0f} bounces, "
          f"{len(sums)} renderings")


main()
