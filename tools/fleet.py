#!/usr/bin/env python3
"""Calibrates the units of one robot type from many logs, on the workers of a
Dask cluster: armcal reduce on each log, armcal merge of all (docs/fleet.md).

  fleet.py --robot=arm.urdf --out=fleet --table=logs.csv
  fleet.py --robot=arm.urdf --out=fleet --scheduler=tcp://head:8786 LOGS...

--table is a CSV with the columns log, unit and date. Without --scheduler the
workers are processes on this machine, one for each core. Needs the Python
package armcal and Debian's python3-distributed. What an earlier run made in
--out is taken over (factors/manifest.jsonl). Exit codes: 0 all logs are in the
result; 1 some were refused, or the verdict is negative; 3 nothing came out;
130 interrupted.
"""

import argparse
import sys

from distributed import Client, LocalCluster

import armcal
from armcal.fleet import Recording, calibrate_fleet, read_table


def parse():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--robot", required=True)
    parser.add_argument("--base", default="")
    parser.add_argument("--tip", default="")
    parser.add_argument("--out", required=True)
    parser.add_argument("--table")
    parser.add_argument("--scheduler", help="address of a Dask scheduler")
    parser.add_argument("--workers", type=int,
                        help="processes on this machine; default: its cores")
    parser.add_argument("--like", help="factor file that says how to reduce")
    parser.add_argument("--set", action="append", default=[],
                        metavar="FLAG=VALUE", help="a flag of armcal reduce")
    parser.add_argument("logs", nargs="*", help="logs of units not told apart")
    given = parser.parse_args()
    if not given.logs and not given.table:
        parser.error("expected --table=FILE or logs")
    for setting in given.set:
        if "=" not in setting:
            parser.error(f"--set: found {setting!r}, expected FLAG=VALUE")
    return given


def connect(given):
    if given.scheduler:
        return Client(given.scheduler)
    # A process for each: commands of armcal take turns within one.
    return Client(LocalCluster(n_workers=given.workers, threads_per_worker=1,
                               processes=True, dashboard_address="127.0.0.1:0"))


def show(count, total):
    if sys.stderr.isatty():
        end = "\n" if count == total else ""
        print(f"\rreduced {count} of {total} logs", end=end, file=sys.stderr,
              flush=True)


def main():
    given = parse()
    recordings = [Recording(log) for log in given.logs]
    try:
        if given.table:
            recordings += read_table(given.table)
        robot = armcal.read_robot(given.robot, given.base, given.tip)
        with connect(given) as client:
            result, refused = calibrate_fleet(
                client, robot, recordings, given.out, like=given.like,
                done=show, **dict(s.split("=", 1) for s in given.set))
    except (ValueError, OSError) as error:
        print(f"fleet.py: {error}", file=sys.stderr)
        return 3
    except KeyboardInterrupt:
        print(f"\nfleet.py: interrupted; what is reduced is in {given.out}/factors,"
              " and the same command goes on from there", file=sys.stderr)
        return 130
    print(result.report(), end="")
    for why in refused.values():
        print(f"fleet.py: left out: {why}", file=sys.stderr)
    return 1 if refused or not result.passed else 0


if __name__ == "__main__":
    sys.exit(main())
