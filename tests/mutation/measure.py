"""Which share of a room's mutants do its tests notice? See tests/mutation/run, and CONTRIBUTING.md.

Each mutant is built into the room's test program, which runs until its first failure, and its file is restored. A
mutant is killed if a test fails, crashes or takes more than three times as long as all tests do without a mutant.
Each result is appended to build/mutation/ROOM-SEED.tsv; a further run goes on after them.
"""

import argparse
import math
import os
import resource
import signal
import subprocess
import sys
import time
from pathlib import Path

from mutants import drawn

ROOT = Path(__file__).resolve().parents[2]
MEMORY_BYTES = 8 << 30  # of one run of the tests

# The tests that are left out: full diagnoses, and others that take a second and more.
SLOW = {
    "transmission": "",
    "estimators": "Identify.*:ExponentialFilters.*:Rates/*",
    "diagnosis": "Attribution.*:Bounds.*:Cases.*:Clock*:DamagedFiles.*:DetectionLimit*:Diagnose*:DropOuts.*:EncoderZero.*"
    ":FastSensors.*:JointDriven*:JointHeld*:JointProposal.*:LateReadings.*:LogCheckOnRecordings.*:LogOf*:LogWith*"
    ":MoreFriction.*:PlanCommand.*:Push.*:Rig.*:RowsOf*:SeveralLogs.*:Slow*:Stuck*:Torque*:UnknownEncoder*:ZeroError.*",
}


class Tests:
    """The test program of a room in a build folder."""

    def __init__(self, room, build):
        self.build_command = ["cmake", "--build", str(build), "--target", f"{room}_tests"]
        self.run_command = [str(build / "tests" / f"{room}_tests"), "--gtest_brief=1", "--gtest_fail_fast",
                            f"--gtest_filter=-{SLOW[room]}"]
        self.cpu_s, self.wall_s = None, None

    def build(self):
        return subprocess.run(self.build_command, cwd=ROOT, capture_output=True).returncode == 0

    def limit(self):
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY_BYTES, MEMORY_BYTES))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        if self.cpu_s:
            resource.setrlimit(resource.RLIMIT_CPU, (self.cpu_s, self.cpu_s))

    def first_failure(self):
        """A word on the first failure, or "" if all tests pass."""
        try:
            done = subprocess.run(self.run_command, cwd=ROOT, capture_output=True, text=True, errors="replace",
                                  preexec_fn=self.limit, timeout=self.wall_s)
        except subprocess.TimeoutExpired:
            return "time"
        if done.returncode == 0:
            return ""
        if done.returncode < 0:
            return f"signal {-done.returncode}"
        failed = [line.split()[3].rstrip(",") for line in done.stdout.splitlines() if line.startswith("[  FAILED  ]")]
        return failed[0] if failed else f"exit code {done.returncode}"

    def calibrate(self):
        """Sets the limits of time: three times what the tests take now, and much more if they wait for others."""
        before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
        failure = self.first_failure()
        if failure:
            sys.exit(f"tests/mutation: without a mutant, {failure} fails")
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        cpu_s = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        self.cpu_s, self.wall_s = math.ceil(3 * cpu_s) + 10, 10 * (time.monotonic() - start) + 60


def verdict(mutant, source, tests):
    """Builds and tests the mutant: "killed", "survived" or "does not compile", and what failed first."""
    path = ROOT / mutant.path
    path.write_text(mutant.apply(source))
    try:
        if not tests.build():
            return "does not compile", ""
        failure = tests.first_failure()
        return ("killed", failure) if failure else ("survived", "")
    finally:
        path.write_text(source)


def line_of(mutant, source):
    """How a result names the mutant: its place, and its line before and after."""
    begin = source.rfind("\n", 0, mutant.start) + 1
    end = source.find("\n", mutant.end)
    number, column = source.count("\n", 0, begin) + 1, mutant.start - begin + 1
    after = source[begin : mutant.start] + mutant.text + source[mutant.end : end]
    return [f"{mutant.path}:{number}:{column}", mutant.operator, *(" ".join(s.split()) for s in (source[begin:end], after))]


def interval(killed, n):
    """Wilson's interval of 95 % for the probability of which killed of n is the estimate."""
    z = 1.96
    centre, width = (killed + z * z / 2) / (n + z * z), z / (n + z * z) * math.sqrt(killed * (n - killed) / n + z * z / 4)
    return centre - width, centre + width


def report(rows):
    outcomes = [row[0] for row in rows]
    killed, survived = outcomes.count("killed"), outcomes.count("survived")
    for row in rows:
        if row[0] == "survived":
            print(f"survived: {row[2]} ({row[3]})\n  - {row[4]}\n  + {row[5]}")
    if killed + survived:
        low, high = interval(killed, killed + survived)
        print(f"killed {killed} of {killed + survived} mutants that compile: {100 * killed / (killed + survived):.0f} %, "
              f"95 % interval {100 * low:.0f} to {100 * high:.0f} %; {outcomes.count('does not compile')} do not compile")


def arguments():
    parser = argparse.ArgumentParser(description="Measures which share of a room's mutants its tests kill.")
    parser.add_argument("room", choices=sorted(SLOW))
    parser.add_argument("--mutants", type=int, default=40, help="how many that compile (40)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--build", type=Path, default=ROOT / "build/mutation", help="build folder (build/mutation)")
    return parser.parse_args()


def main():
    chosen = arguments()
    listed = subprocess.check_output(["git", "ls-files", "*.cpp", "*.h"], cwd=ROOT / chosen.room, text=True).split()
    if subprocess.check_output(["git", "status", "--porcelain", "--", chosen.room], cwd=ROOT):
        sys.exit(f"tests/mutation: {chosen.room} has changes that are not committed; commit them, so that they cannot get lost")
    sources = {f"{chosen.room}/{name}": (ROOT / chosen.room / name).read_text() for name in listed}
    results = ROOT / "build/mutation" / f"{chosen.room}-{chosen.seed}.tsv"
    results.parent.mkdir(parents=True, exist_ok=True)
    rows = [line.split("\t") for line in results.read_text().splitlines()] if results.exists() else []
    tests = Tests(chosen.room, chosen.build)
    if not tests.build():
        sys.exit("tests/mutation: the room does not compile without a mutant")
    tests.calibrate()
    for mutant in drawn(sources, chosen.seed)[len(rows) :]:
        if sum(row[0] != "does not compile" for row in rows) >= chosen.mutants:
            break
        outcome, failure = verdict(mutant, sources[mutant.path], tests)
        rows.append([outcome, failure, *line_of(mutant, sources[mutant.path])])
        with results.open("a") as file:
            file.write("\t".join(rows[-1]) + "\n")
        print(f"{len(rows)}: {outcome} {failure}: {rows[-1][2]} {rows[-1][5]}", flush=True)
    report(rows)


if __name__ == "__main__":
    os.environ["GTEST_COLOR"] = "no"
    signal.signal(signal.SIGTERM, lambda *_: sys.exit("tests/mutation: ended"))  # which restores the file
    main()
