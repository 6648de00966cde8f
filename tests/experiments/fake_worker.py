"""In the place of the worker: what it does depends on the run's number of targets, and it logs each start to a file.

n = 5: answers after time_limit s. n = 1: aborts. n = 2: takes memory. n = 3: exits with a status. n = 4: never ends.
n = 6: kills the process that started it, and so itself.
"""

import json
import os
import signal
import sys
import time


def main():
    run = json.load(sys.stdin)
    if len(sys.argv) > 1:
        with open(sys.argv[1], "a") as log:
            log.write(f"{run['index']}\n")
    if run["n"] == 1:
        os.abort()
    if run["n"] == 2:
        taken = bytearray(300 * 2**20)
        taken[::4096] = b"x" * len(taken[::4096])  # touched, so that it is resident
        time.sleep(60)
    if run["n"] == 3:
        sys.exit("the solver gave up")
    if run["n"] == 6:
        os.kill(os.getppid(), signal.SIGKILL)
    time.sleep(60 if run["n"] == 4 else run["time_limit"])
    json.dump({"status": "optimal", "objective": 1.5, "tours": "[]"}, sys.stdout)


main()
