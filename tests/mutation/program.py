"""The test program of a folder: builds it, and runs its fast tests until the first failure.

The tests that are most likely to notice a mutant run first: those whose file includes the header of the changed file or
has its name, then those of the folder of its name, then those that take less than 0.3 s, then the others.
"""

import json
import math
import os
import resource
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

MEMORY_BYTES = 8 << 30  # of one run of the tests
QUICK_S = 0.3
BUILD_S = 3600  # a mutant of a constant expression may keep the compiler busy for ever

# The tests that are left out: full diagnoses, and others that take some seconds.
SLOW = {
    "transmission": "",
    "estimators": "Identify.*:ExponentialFilters.*",
    "diagnosis": "Cases.*:Clock*:DamagedFiles.*:DetectionLimit*:Diagnose*:DropOuts.*:EncoderZero.*:JointDriven*"
    ":JointProposal.FindsTwo*:LogCheckOnRecordings.*:LogOf*:LogWith*:MoreFriction.*:PlanCommand.*:Push.*:Rates/*:Rig.*"
    ":RowsOf*:SeveralLogs.*:SlowJointSensor.*:SlowLog.*:UnknownEncoder*:ZeroError.*",
}


def processes_of_session(leader):
    """The processes that still run in a session. Ninja gives each compiler a process group of its own."""
    found = []
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            state, _, _, session = stat.read_text().rpartition(")")[2].split()[:4]
        except (FileNotFoundError, ProcessLookupError):
            continue
        if int(session) == leader and state not in "ZX":
            found.append(int(stat.parent.name))
    return found


def run(command, seconds, **options):
    """The exit code and the output of the command; the code is None if it took longer.

    However this ends, no process of the command is left: a compiler that goes on would write the object of a mutant
    after the mutant's file is restored, and the next build would take it for that of the restored file.
    """
    with subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          errors="replace", start_new_session=True, **options) as process:
        try:
            output = process.communicate(timeout=seconds)[0]
            return process.returncode, output
        except subprocess.TimeoutExpired:
            return None, ""
        finally:
            while left := processes_of_session(process.pid):
                for pid in left:
                    try:
                        os.kill(pid, signal.SIGKILL)
                    except ProcessLookupError:
                        pass
                time.sleep(0.01)


class Tests:
    """The test program of a folder in a build folder."""

    def __init__(self, folder, build, root):
        self.root = root
        self.build_command = ["cmake", "--build", str(build), "--target", f"{folder}_tests"]
        self.program, self.slow = str(build / "tests" / f"{folder}_tests"), SLOW[folder]
        self.cpu_per_s = 1
        self.times, self.files = {}, {}  # of each test: s that it takes without a mutant, its file

    def build(self):
        return run(self.build_command, BUILD_S, cwd=self.root)[0] == 0

    def failure_of(self, tests):
        """A word on the first failure of these tests, or "" if they pass."""
        # Three times what they take now, and much more if they wait for other programs.
        expected_s = sum(self.times[test] for test in tests)
        cpu_s, wall_s = math.ceil(3 * expected_s * self.cpu_per_s) + 10, 10 * expected_s + 60
        code, output = self.run_tests(":".join(tests), cpu_s, wall_s)
        if code is None:
            return "time"
        if code == 0:
            return ""
        if code < 0:
            return f"signal {-code}"
        failed = [line.split()[3].rstrip(",") for line in output.splitlines() if line.startswith("[  FAILED  ]")]
        return failed[0] if failed else f"exit code {code}"

    def run_tests(self, which, cpu_s, wall_s, *more):
        def limit():
            resource.setrlimit(resource.RLIMIT_AS, (MEMORY_BYTES, MEMORY_BYTES))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            resource.setrlimit(resource.RLIMIT_CPU, (cpu_s, cpu_s))

        command = [self.program, "--gtest_brief=1", "--gtest_fail_fast", f"--gtest_filter={which}", *more]
        return run(command, wall_s, cwd=self.root, preexec_fn=limit)

    def calibrate(self):
        """Runs all fast tests and keeps what each takes."""
        before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
        with tempfile.TemporaryDirectory() as folder:
            report = Path(folder) / "report.json"
            code, output = self.run_tests(f"-{self.slow}", 3600, 3600, f"--gtest_output=json:{report}")
            if code != 0:
                sys.exit(f"tests/mutation: without a mutant, the tests fail:\n{output}")
            suites = json.loads(report.read_text())["testsuites"]
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        cpu_s = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        self.cpu_per_s = cpu_s / (time.monotonic() - start)
        for test in (test for suite in suites for test in suite["testsuite"]):
            name = f"{test['classname']}.{test['name']}"
            self.times[name], self.files[name] = float(test["time"].rstrip("s")), Path(test["file"])

    def first_failure(self, changed):
        """A word on the first failure of the fast tests after a change of this file, or "" if all pass."""
        name, header = Path(changed).stem, str(Path(changed).with_suffix(".h"))
        folder = self.root / "tests" / Path(changed).parent
        is_near = [
            lambda test: name in self.files[test].stem or f'#include "{header}"' in self.files[test].read_text(),
            lambda test: self.files[test].parent == folder != self.root / "tests" / Path(changed).parts[0],
            lambda test: self.times[test] < QUICK_S,
            lambda test: True,
        ]
        left = list(self.times)
        for is_of_stage in is_near:
            stage = [test for test in left if is_of_stage(test)]
            left = [test for test in left if test not in stage]
            if stage and (failure := self.failure_of(stage)):
                return failure
        return ""
