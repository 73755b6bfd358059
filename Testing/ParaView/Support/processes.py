"""Runs ParaView's programs for the tests that compare one process with several, and with servers."""

import os
import subprocess
import sys

# The tests' first argument.
PROGRAMS = sys.argv.pop(1)
# Open MPI refuses to run as root, and more processes than cores, unless told to.
os.environ.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
MPIRUN = ["mpirun", "--map-by", ":OVERSUBSCRIBE", "-np"]


def program(name):
    return os.path.join(PROGRAMS, name)


def script(name):
    return os.path.join(os.path.dirname(os.path.abspath(__file__)), name)


def file_of(prefix, name):
    return os.path.join(os.environ["VTKSVO_OUTPUT"], f"{prefix}-{name}.png")


def run(command, refused=("ERR|",)):
    """What it prints; nothing of that may be refused."""
    result = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=240)
    print(result.stdout)
    if result.returncode != 0 or any(text in result.stdout for text in refused):
        raise AssertionError(f"{command} ended with {result.returncode}")
    return result.stdout


def run_with_server(server_command, client_command, port, refused=("ERR|",)):
    """What the client prints."""
    server = subprocess.Popen(server_command + [f"--server-port={port}"], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True)
    try:
        for line in server.stdout:
            if "Accepting connection" in line:
                break
        output = run(client_command + [str(port)], refused)
        said = server.communicate(timeout=60)[0]
        if any(text in said for text in refused):
            raise AssertionError(f"{server_command} said: {said}")
        return output
    finally:
        server.kill()
        server.wait()
