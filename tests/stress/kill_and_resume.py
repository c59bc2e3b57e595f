#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the ltcfit authors
"""Kills `ltcfit generate` with SIGKILL at random moments, resumes it, and compares the files with
those of an undisturbed run, byte for byte but for the time of creation.

    tests/stress/kill_and_resume.py build/release/ltcfit [--kills 20] [--seed 1] [-- OPTION...]

Every kill is a trial of its own: a fresh folder with older files in it, one kill at a moment drawn
uniformly from the time that the undisturbed run takes, then --resume to the end. A run that is done
before its moment is no trial: another moment is drawn. Options after -- go to `ltcfit generate`;
without any, it is the default config. Exit code 1 if a trial fails.
"""
import argparse
import pathlib
import random
import re
import signal
import subprocess
import sys
import tempfile
import time

OLD = b"an older file"
CHECKPOINT = "ltc.checkpoint.h5"


def read_files(folder):
    """Name -> bytes; the HDF5 file's time of creation blanked."""
    files = {path.name: path.read_bytes() for path in folder.iterdir()}
    if files.get("ltc.h5", OLD) != OLD:
        files["ltc.h5"], times = re.subn(rb"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", b"-" * 20,
                                         files["ltc.h5"])
        assert times == 1, f"{times} times of creation instead of one"
    return files


def start(arguments, folder, log, resume=False):
    command = [arguments.program.resolve(), "generate", "--output", folder,
               "--checkpoint-seconds", str(arguments.checkpoint_seconds), *arguments.options]
    return subprocess.Popen([*command, "--resume"] if resume else command, stdout=log, stderr=log)


def undisturbed_run(arguments, folder, log):
    began = time.monotonic()
    if start(arguments, folder, log).wait() != 0:
        sys.exit(f"the undisturbed run failed: {log.name}")
    return read_files(folder), time.monotonic() - began


def killed_run(arguments, folder, log, expected, moment):
    """Whether a run in the folder, with older files there, was killed at the moment."""
    for name in expected:
        (folder / name).write_bytes(OLD)
    process = start(arguments, folder, log)
    try:
        process.wait(timeout=moment)
    except subprocess.TimeoutExpired:
        process.send_signal(signal.SIGKILL)
    return process.wait() == -signal.SIGKILL


def fault_after_kill(arguments, folder, log, expected):
    """What is wrong with the files that a kill left, or with those of the resumed run; or nothing."""
    left = read_files(folder)
    for name in expected:
        if left[name] not in (OLD, expected[name]):
            return f"{name} is neither the older file nor the new one after the kill"
    code = start(arguments, folder, log, resume=True).wait()
    if code != 0:
        return f"the resumed run ended with {code}"
    files = read_files(folder)
    if files.keys() != expected.keys():
        return f"files {sorted(files)}; expected {sorted(expected)}"
    different = [name for name in files if files[name] != expected[name]]
    return f"other bytes in {', '.join(different)}" if different else ""


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--kills", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--checkpoint-seconds", type=float, default=0.2)
    words = sys.argv[1:]
    end = words.index("--") if "--" in words else len(words)
    arguments = parser.parse_args(words[:end])
    arguments.options = words[end + 1:]  # those of ltcfit
    moments = random.Random(arguments.seed)
    failed = with_checkpoint = 0
    with tempfile.TemporaryDirectory() as base, tempfile.NamedTemporaryFile(
            prefix="kill-and-resume-", suffix=".log", delete=False) as log:
        base = pathlib.Path(base)
        (base / "undisturbed").mkdir()
        expected, seconds = undisturbed_run(arguments, base / "undisturbed", log)
        print(f"undisturbed: {seconds:.2f} s, {len(expected)} files")
        kills = 0
        while kills < arguments.kills:
            folder = pathlib.Path(tempfile.mkdtemp(dir=base))
            moment = moments.uniform(0, seconds)
            if not killed_run(arguments, folder, log, expected, moment):
                continue
            kills += 1
            kept = (folder / CHECKPOINT).exists()
            with_checkpoint += kept
            fault = fault_after_kill(arguments, folder, log, expected)
            failed += bool(fault)
            print(f"{kills:3}: killed after {moment:.2f} s with {'a' if kept else 'no'} checkpoint: "
                  f"{fault or 'same bytes'}", flush=True)
    print(f"{arguments.kills - failed} of {arguments.kills} resumed to the same bytes; "
          f"{with_checkpoint} from a checkpoint, the others from the beginning")
    sys.exit(1 if failed else 0)


main()
