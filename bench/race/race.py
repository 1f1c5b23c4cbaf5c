#!/usr/bin/env python3
"""Runs octrace against other ray tracers on the same solids, and says who is how fast. See README.md."""

from __future__ import annotations

import argparse
import datetime
import importlib.metadata
import json
import os
import platform
import subprocess
import sys
from pathlib import Path

from race import digest, report
from race.scenes import QUICK, SCENES

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]


def main() -> None:
    args = arguments()
    if args.digests:
        names = [name for name in SCENES if not name.endswith("100000")]
        (HERE / "digests.txt").write_text("".join(f"{name} {digest.digest(SCENES[name]())}\n" for name in names))
        return
    from race import contest, povray

    programs = build(args)
    results = []
    for name in args.scenes or (QUICK if args.quick else SCENES):
        print(f"{name} ...", file=sys.stderr, flush=True)
        results.append(contest.run(SCENES[name](), programs))
        about = {
            "date": datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d"),
            "machine": machine(),
            "versions": versions(povray.version()),
            "repeat": args.repeat,
        }
        # After every scene: what is there stays if the race is ended early.
        args.out.with_suffix(".json").write_text(json.dumps({"about": about, "scenes": results}, indent=1) + "\n")
        args.out.with_suffix(".md").write_text(report.markdown(results, about))
    print(args.out.with_suffix(".md").read_text())


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scenes", type=lambda text: text.split(","), help="names, separated by commas")
    parser.add_argument("--quick", action="store_true", help="the small scenes only")
    parser.add_argument("--repeat", type=int, default=5, help="rounds")
    parser.add_argument("--patience", type=float, default=120.0, help="seconds that a program may take for anything")
    parser.add_argument(
        "--rivals",
        type=lambda text: set(text.split(";")),
        default={"Embree", "embreex", "POV-Ray", "POV-Ray, cells", "fidget"},
        help="names, separated by semicolons",
    )
    parser.add_argument("--out", type=Path, default=Path("race"), help="results go to OUT.json and OUT.md")
    parser.add_argument("--work", type=Path, default=Path("/tmp/octrace-race"), help="a folder for everything else")
    parser.add_argument("--digests", action="store_true", help="only write digests.txt anew")
    args = parser.parse_args()
    for name in args.scenes or ():
        if name not in SCENES:
            parser.error(f"there is no scene {name!r}, only {', '.join(SCENES)}")
    return args


def build(args: argparse.Namespace):
    """Compiles what is to be compiled."""
    from race.contest import Programs

    args.work.mkdir(parents=True, exist_ok=True)
    target = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")).resolve()
    cargo = ["cargo", "build", "--release", "--quiet"]
    subprocess.run([*cargo, "-p", "octrace-cli"], cwd=ROOT, check=True)
    runners = target / "race"
    environment = os.environ | {"CARGO_TARGET_DIR": str(runners)}
    subprocess.run(cargo, cwd=HERE / "runners", check=True, env=environment)
    embree = args.work / "trace-embree"
    source = HERE / "embree" / "trace.cpp"
    subprocess.run(["g++", "-std=c++17", "-O3", "-march=native", "-o", embree, source, "-lembree3"], check=True)
    return Programs(
        octrace=target / "release" / "octrace",
        runners=runners / "release",
        embree=embree,
        work=args.work.resolve(),
        patience_s=args.patience,
        repeat=args.repeat,
        rivals=args.rivals,
    )


def machine() -> str:
    names = [line.split(":")[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name")]
    return f"{names[0] if names else platform.processor()}, {os.cpu_count()} hardware threads"


def versions(povray: str) -> str:
    packages = ", ".join(f"{name} {importlib.metadata.version(name)}" for name in ("manifold3d", "embreex"))
    embree = subprocess.run(["pkg-config", "--modversion", "embree3"], capture_output=True, text=True).stdout.strip()
    if not embree:
        found = subprocess.run(["dpkg-query", "-W", "-f", "${Version}", "libembree-dev"], capture_output=True, text=True)
        embree = found.stdout.strip()
    return f"Embree {embree}, {packages}, {povray}, fidget 0.5.1"


if __name__ == "__main__":
    main()
