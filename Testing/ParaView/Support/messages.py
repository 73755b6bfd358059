"""What a process writes for people to read."""

import os
import sys
import tempfile


class Output:
    """What the process writes meanwhile, ParaView's own messages included."""

    def __enter__(self):
        sys.stdout.flush()
        self.file = tempfile.TemporaryFile()
        self.saved = [os.dup(1), os.dup(2)]
        os.dup2(self.file.fileno(), 1)
        os.dup2(self.file.fileno(), 2)
        return self

    def __exit__(self, *_):
        sys.stdout.flush()
        for number, saved in zip((1, 2), self.saved):
            os.dup2(saved, number)
            os.close(saved)
        self.file.seek(0)
        self.text = self.file.read().decode(errors="replace")

    def messages(self):
        return [line for line in self.text.splitlines() if "ERR|" in line or "WARN|" in line]
