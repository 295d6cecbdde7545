#!/usr/bin/env python3
"""Writes poses.csv: two targets on the tool of a SCARA whose upper arm is 2 mm
longer, whose forearm is 1 mm shorter and whose elbow is off by 0.1 degree
against robot.yaml, seen by a tracker that stands somewhere else. In closed
form, without noise."""
import math
import os
import random

UPPER, FOREARM, ELBOW = 0.402, 0.299, math.radians(0.1)  # m, m, rad
YAW, TRACKER = 0.7, (1.2, -0.5, 0.8)  # of the arm's base in the tracker's frame
TARGETS = ((0.05, 0.02, 0.1), (-0.03, 0.06, 0.12))  # m, in the tool's frame


def target(q, p):
    upper, fore = q[0], q[0] + q[1] + ELBOW
    tool = fore + q[3]
    x = UPPER * math.cos(upper) + FOREARM * math.cos(fore)
    y = UPPER * math.sin(upper) + FOREARM * math.sin(fore)
    x += p[0] * math.cos(tool) - p[1] * math.sin(tool)
    y += p[0] * math.sin(tool) + p[1] * math.cos(tool)
    z = q[2] + p[2]
    return (TRACKER[0] + math.cos(YAW) * x - math.sin(YAW) * y,
            TRACKER[1] + math.sin(YAW) * x + math.cos(YAW) * y,
            TRACKER[2] + z)


def main():
    rng = random.Random(1)
    folder = os.path.dirname(os.path.abspath(__file__))
    with open(os.path.join(folder, 'poses.csv'), 'w', newline='\n') as file:
        file.write('q1,q2,q3,q4,x1,y1,z1,x2,y2,z2\n')
        for _ in range(40):
            q = [round(rng.uniform(-2, 2), 4), round(rng.uniform(-2.5, 2.5), 4),
                 round(rng.uniform(0, 0.15), 4), round(rng.uniform(-3, 3), 4)]
            row = q + [x for p in TARGETS for x in target(q, p)]
            file.write(','.join('%.9g' % x for x in row) + '\n')


if __name__ == '__main__':
    main()
