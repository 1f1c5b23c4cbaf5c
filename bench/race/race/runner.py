"""Programs that stay alive between rounds, so that they read and build only once."""

from __future__ import annotations

import json
import selectors
import subprocess
from dataclasses import dataclass
from pathlib import Path


class TooSlow(Exception):
    """The race waits no longer."""


@dataclass(frozen=True)
class Took:
    cpu_s: float
    wall_s: float
    rays: int | None = None


class Runner:
    """One program and its input. Every command is answered by one JSON object on one line."""

    def __init__(self, name: str, command: list[str | Path], patience_s: float):
        self.name, self.patience_s = name, patience_s
        self.process = subprocess.Popen(
            [str(word) for word in command], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1
        )
        self.selector = selectors.DefaultSelector()
        self.selector.register(self.process.stdout, selectors.EVENT_READ)
        self.ready = self.answer()

    def ask(self, command: str) -> Took:
        self.process.stdin.write(command + "\n")
        self.process.stdin.flush()
        return self.answer()

    def answer(self) -> Took:
        if not self.selector.select(self.patience_s):
            self.close()
            raise TooSlow(f"takes more than {self.patience_s:.0f} s")
        line = self.process.stdout.readline()
        if not line:
            raise RuntimeError(f"{self.name} ended: {self.process.wait()}")
        return Took(**json.loads(line))

    def close(self) -> None:
        self.process.kill()
        self.process.wait()
        self.process.stdin.close()
        self.process.stdout.close()
