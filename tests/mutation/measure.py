"""Which share of a folder's mutants do its tests notice? See tests/mutation/run, and CONTRIBUTING.md.

Each mutant is built into the folder's test program, which runs until its first failure, and its file is restored. A
mutant is killed if a test fails, crashes or takes more than three times as long as without a mutant. Each result is
appended to build/mutation/FOLDER-SEED.tsv; a further run goes on after them. equivalent.tsv lists mutants that no test
can kill, with the reason.
"""

import argparse
import hashlib
import math
import os
import signal
import subprocess
import sys
from pathlib import Path

from mutants import drawn
from program import Tests

ROOT = Path(__file__).resolve().parents[2]


ENDINGS = (signal.SIGTERM, signal.SIGHUP, signal.SIGINT)


def verdict(mutant, source, tests):
    """Builds and tests the mutant: "killed", "survived" or "does not compile", and what failed first."""
    path = ROOT / mutant.path
    try:
        path.write_text(mutant.apply(source))
        if not tests.build():
            return "does not compile", ""
        failure = tests.first_failure(mutant.path)
        return ("killed", failure) if failure else ("survived", "")
    finally:
        signal.pthread_sigmask(signal.SIG_BLOCK, ENDINGS)
        path.write_text(source)
        signal.pthread_sigmask(signal.SIG_UNBLOCK, ENDINGS)


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


def share(name, killed, n):
    low, high = interval(killed, n)
    return f"{name}: {killed} of {n} killed, {100 * killed / n:.0f} %, 95 % interval {100 * low:.0f} to {100 * high:.0f} %"


def equivalents():
    """The mutants that no test can kill, {(path, line before, line after): reason}."""
    lines = (Path(__file__).parent / "equivalent.tsv").read_text().splitlines()[1:]
    return {tuple(line.split("\t")[:3]): line.split("\t")[3] for line in lines}


def report(rows):
    known, same, outcomes = equivalents(), 0, [row[0] for row in rows]
    killed, survived = outcomes.count("killed"), outcomes.count("survived")
    for outcome, _, place, operator, before, after in rows:
        if outcome == "survived":
            reason = known.get((place.split(":")[0], before, after))
            same += reason is not None
            print(f"survived: {place} ({operator})" + (f"; equivalent: {reason}" if reason else ""))
            print(f"  - {before}\n  + {after}")
    if killed + survived:
        print(share("mutants that compile", killed, killed + survived))
    if same and killed + survived > same:
        print(share("without those that are equivalent", killed, killed + survived - same))
    print(f"{outcomes.count('does not compile')} do not compile")


def results_so_far(file, sources):
    """The rows of a file of results. Its first line names the sources, because the mutants are drawn from them."""
    state = "sources " + hashlib.sha1(repr(sorted(sources.items())).encode()).hexdigest()[:12]
    if not file.exists():
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(state + "\n")
    found, *rows = file.read_text().splitlines()
    if found != state:
        sys.exit(f"tests/mutation: the results in {file} are of other sources; take another --seed, or remove that file")
    return [row.split("\t") for row in rows]


def arguments():
    parser = argparse.ArgumentParser(description="Measures which share of a folder's mutants its tests kill.")
    parser.add_argument("folder", choices=["diagnosis", "estimators", "transmission"])
    parser.add_argument("--mutants", type=int, default=40, help="how many that compile (40)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--build", type=Path, default=ROOT / "build/mutation", help="build folder (build/mutation)")
    return parser.parse_args()


def main():
    chosen = arguments()
    listed = subprocess.check_output(["git", "ls-files", "*.cpp", "*.h"], cwd=ROOT / chosen.folder, text=True).split()
    if subprocess.check_output(["git", "status", "--porcelain", "--", chosen.folder], cwd=ROOT):
        sys.exit(f"tests/mutation: {chosen.folder} has changes that are not committed; commit them, so that they cannot get lost")
    sources = {f"{chosen.folder}/{name}": (ROOT / chosen.folder / name).read_text() for name in listed}
    results = ROOT / "build/mutation" / f"{chosen.folder}-{chosen.seed}.tsv"
    rows = results_so_far(results, sources)
    tests = Tests(chosen.folder, chosen.build, ROOT)
    if not tests.build():
        sys.exit("tests/mutation: the folder does not compile without a mutant")
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
    for ending in ENDINGS:
        signal.signal(ending, lambda *_: sys.exit("tests/mutation: ended"))  # which restores the file
    main()
