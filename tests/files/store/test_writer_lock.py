import os
import subprocess
import sys
import threading
import time

import pytest

from evenbreak.files.store import folder as folder_module
from evenbreak.files.store.folder import LOCK, check_folder, sole_writer, write_files

HOLDER = """
import sys
from pathlib import Path
from evenbreak.files.store.folder import sole_writer
with sole_writer(Path(sys.argv[1])):
    print("held", flush=True)
    sys.stdin.read()
"""


@pytest.fixture
def holder(tmp_path):
    """Start another process that is writing into the folder."""
    with subprocess.Popen(
        [sys.executable, "-c", HOLDER, str(tmp_path)], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    ) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == b"held\n"
        yield process
        process.kill()


def test_a_second_writer_waits_and_is_told_why(holder, tmp_path, monkeypatch):
    monkeypatch.setattr(folder_module, "PATIENCE", 0.1)
    with pytest.raises(OSError, match="another run is writing to it"):
        write_files(tmp_path, {"a.csv": b"1"})
    with pytest.raises(OSError, match="another run is writing to it"):
        check_folder(tmp_path / "deep" / "sheet")
    assert [path.name for path in tmp_path.iterdir()] == [LOCK]
    holder.communicate()
    write_files(tmp_path, {"a.csv": b"1"})
    assert [path.name for path in tmp_path.iterdir()] == ["a.csv"]


def test_the_lock_of_a_killed_run_blocks_nobody(holder, tmp_path):
    holder.kill()
    holder.wait()
    assert (tmp_path / LOCK).exists() or os.name != "posix"
    write_files(tmp_path, {"a.csv": b"1"})
    assert [path.name for path in tmp_path.iterdir()] == ["a.csv"]


def test_many_writers_at_once_leave_one_whole_result(tmp_path):
    folder = tmp_path / "deep" / "sheet"
    names = [f"{number}.csv" for number in range(5)]

    def write(number):
        write_files(folder, dict.fromkeys(names, b"%d" % number))

    threads = [threading.Thread(target=write, args=(number,)) for number in range(12)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert sorted(path.name for path in folder.iterdir()) == names
    assert len({path.read_bytes() for path in folder.iterdir()}) == 1
    assert [path.name for path in tmp_path.iterdir()] == ["deep"]


def test_a_file_system_without_locks_is_written_to(tmp_path, monkeypatch):
    fcntl = pytest.importorskip("fcntl")

    def none(*_):
        raise OSError(38, "Function not implemented")

    monkeypatch.setattr(fcntl, "flock", none)
    begun = time.monotonic()
    with sole_writer(tmp_path) as alone:
        assert alone
    assert time.monotonic() - begun < 1.0
