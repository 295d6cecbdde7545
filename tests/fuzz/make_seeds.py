#!/usr/bin/env python3
"""make_seeds.py ARMCAL DATA FOLDER: seeds of every fuzz target.

Small valid files of every kind, from which mutations begin: FOLDER/<target>/.
What armcal writes it writes itself; bags and .mat files are those of
data/log_formats, which other programs wrote.
"""

import gzip
import pathlib
import shutil
import subprocess
import sys
import tarfile
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
CHECKSUM = 32  # bytes at the end of a factor file


def armcal_files(armcal, folder):
    """What the commands write for the arm: {target: [files]}."""
    def run(*arguments):
        subprocess.run([armcal, *arguments], cwd=folder, check=False,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    arm = f"--robot={HERE / 'arm.yaml'}"
    run("simulate", arm, "--duration=10", "--log_rate=50", "--out=log")
    log = "log/log.csv"
    run("calibrate", arm, f"--log={log}", "--out=all", "--export=mjcf,sdf,yaml")
    given = folder / "given"
    given.write_bytes((folder / "all/calibration.json").read_bytes() + b"\0" +
                      (folder / "all/covariance.csv").read_bytes())
    posterior = folder / "posterior"
    posterior.write_bytes((folder / "all/calibration.json").read_bytes() + b"\0" +
                          (folder / "all/parameters_posterior.csv").read_bytes())
    short = folder / "short.csv"
    lines = (folder / log).read_text().splitlines(keepends=True)
    short.write_text("".join(lines[:40]))
    run("reduce", arm, f"--log={log}", "--out=factors")
    made = {"json": ["all/calibration.json"],
            "urdf": ["all/robot.urdf"], "mjcf": ["all/robot.xml"],
            "yaml": ["all/robot.yaml"], "csv": ["short.csv"], "given": ["given"],
            "posterior": ["posterior"], "factor": ["factors/*.factor"]}
    return {target: [file for name in names for file in folder.glob(name)]
            for target, names in made.items()}


def main():
    armcal, data, out = (pathlib.Path(a).resolve() for a in sys.argv[1:])
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder) / "made"
        folder.mkdir()
        seeds = armcal_files(armcal, folder)
        with tarfile.open(data / "log_formats/written.tar.xz") as archive:
            archive.extractall(folder / "written")
        csv = data / "log_formats/log.csv"
        subprocess.run(["/usr/bin/python3", HERE.parent / "write_npz.py", csv,
                        folder / "npz"], check=True)
        zipped = folder / "log.csv.gz"
        zipped.write_bytes(gzip.compress(csv.read_bytes()))
        poses = folder / "poses.csv"
        poses.write_text(
            "q1,q2,x1,y1,z1,u95_1\n.1,.2,1,2,3,.01\n.3,.4,2,3,4,.01\n")
        controller = folder / "controller.yaml"
        controller.write_text("rate: 500\nkp: [100, 50]\nkd: [10, 5]\nki: [1, 1]"
                              "\ntorque_limit: [90, 40]\nvelocity_filter: 80\n"
                              "feedforward: gravity\n")
        for target, files in {
                "csv": [csv], "gz": [zipped],
                "db3": (folder / "written").glob("*.db3"),
                "mcap": (folder / "written").glob("*.mcap"),
                "wrench": [folder / "written/wrench.mcap"],
                "npz": (folder / "npz").glob("*.npz"),
                "mat": (folder / "written").glob("*.mat"),
                "urdf": [data / "six_axis/robot.urdf"],
                "yaml": [data / "scara/robot.yaml", data / "six_axis/real.yaml",
                         HERE / "arm.yaml"],
                "poses": [poses, data / "scara/poses.csv"],
                "metadata": (folder / "written").glob("*/metadata.yaml"),
                "controller": [controller]}.items():
            seeds.setdefault(target, []).extend(files)
        for target, files in seeds.items():
            (out / target).mkdir(parents=True, exist_ok=True)
            for file in files:
                to = out / target / (file.parent.name + "_" + file.name)
                shutil.copyfile(file, to)
                if target == "factor":  # which the target puts there itself
                    to.write_bytes(to.read_bytes()[:-CHECKSUM])


if __name__ == "__main__":
    main()
