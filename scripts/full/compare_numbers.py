#!/usr/bin/env python3
"""Compares two files of one number a line; fails where two differ by more than 1e-9 of them and 1e-12."""
import sys

with open(sys.argv[1]) as first, open(sys.argv[2]) as second:
    a, b = [float(line) for line in first], [float(line) for line in second]
pairs = list(zip(a, b))
largest = max((abs(x - y) for x, y in pairs), default=0.0)
apart = [i for i, (x, y) in enumerate(pairs) if not abs(x - y) <= 1e-9 * max(abs(x), abs(y)) + 1e-12]
same = sum(x == y for x, y in pairs)
print(f"{len(a)} and {len(b)} numbers, {same} the same to the last bit, largest difference {largest:.3g}")
if apart:
    print(f"{len(apart)} do not agree, the first in line {apart[0] + 1}: {a[apart[0]]!r} and {b[apart[0]]!r}")
sys.exit(bool(apart) or len(a) != len(b) or not a)
