"""Processes: forks, fresh ones, and interpreters within one."""

import concurrent.futures
import multiprocessing
import os
import pickle
import subprocess
import sys
import threading

import numpy as np
import pytest

import calligraphy as cal

PROFILE = cal.device_profile("desktop")
PAGE = cal.lay_out([cal.built_in_characters()["一"]])[0]
forks = pytest.mark.skipif(not hasattr(os, "fork"), reason="there is no fork here")
# Python 3.12 on warns of any fork of a process with threads; whether that goes well is what is tested here.
quiet = pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")


def whole(rows):
    """The bytes of a structured array, but for those between its columns."""
    return b"".join(rows[name].tobytes() for name in rows.dtype.names)


def work(seed):
    """Something of every component, as bytes."""
    renderer = cal.RendererOptions.for_device(PROFILE)
    options = cal.SessionOptions(device=PROFILE, renderer=renderer, seed=seed)
    recording = cal.write_page(PAGE, options)
    found = cal.nearest_point([[0, 0], [1, 2], [3, 0]], np.random.default_rng(seed).normal(size=(500, 2)))
    small = cal.StabilityMapOptions(
        with_sweeps=False, per_decade=1, dampings=[0.5], rates=[1000.0], delays=[0], encoder_steps=[0.0],
        wall_dampings=[0.0], grips=[cal.GripImpedance(mass=0, damping=0, stiffness=0)], contact=cal.WallContact(seconds=0.1),
    )  # fmt: skip
    score = cal.score_page(PAGE, recording)[0]
    return pickle.dumps([whole(recording.samples), found.point.tobytes(), repr(score), whole(cal.stability_map(small)["grid"])])


def forked(call):
    """What call() gives in a fork of this process."""
    reader, writer = os.pipe()
    child = os.fork()
    if child == 0:
        status = 1
        try:
            os.close(reader)
            with os.fdopen(writer, "wb") as out:
                out.write(call())
            status = 0
        finally:
            os._exit(status)
    os.close(writer)
    with os.fdopen(reader, "rb") as given:
        result = given.read()
    assert os.waitpid(child, 0)[1] == 0
    return result


@forks
@quiet
def test_a_fork_does_what_its_parent_does():
    expected = work(1)  # also: whatever is made once is made before the fork
    assert forked(lambda: work(1)) == expected
    assert work(1) == expected


@forks
@quiet
def test_a_fork_within_a_session_goes_on_by_itself():
    """Both processes have the renderer, the device and the open callback; both end the session."""
    options = cal.SessionOptions(device=PROFILE)

    def session(in_the_middle):
        ticks = 0

        def motion(tick, seconds):
            nonlocal ticks
            ticks += 1
            if ticks == 20:
                in_the_middle()
            return cal.Intention(position=(0.05, 0.05, 0.01 - 1e-4 * ticks)) if ticks < 60 else None

        return whole(cal.run_session(PAGE, options, motion).samples)

    expected = session(lambda: None)
    reader, writer = os.pipe()
    children = []

    def fork():
        children.append(os.fork())

    result = b""
    try:
        result = session(fork)
    finally:
        if children == [0]:
            os.write(writer, b"same" if result == expected else b"other")
            os._exit(0)
    os.close(writer)
    with os.fdopen(reader, "rb") as given:
        assert given.read() == b"same"
    assert os.waitpid(children[0], 0)[1] == 0 and result == expected


@forks
@quiet
def test_a_fork_while_another_thread_is_at_work():
    """The child has the forking thread alone; nothing of C++ waits for the other one."""
    stop = threading.Event()

    def busy():
        while not stop.is_set():
            cal.nearest_point([[0, 0], [1, 2], [3, 0]], np.zeros((10_000, 2)))

    other = threading.Thread(target=busy)
    other.start()
    try:
        assert forked(lambda: work(2)) == work(2)
    finally:
        stop.set()
        other.join()


@pytest.mark.parametrize("method", multiprocessing.get_all_start_methods())
@quiet
def test_processes_of_every_kind_do_the_same(method):
    context = multiprocessing.get_context(method)
    with concurrent.futures.ProcessPoolExecutor(1, mp_context=context) as pool:
        assert list(pool.map(work, [1, 2])) == [work(1), work(2)]


def test_a_second_interpreter_of_the_same_process_is_refused():
    """Were it loaded there, it would wait forever for itself, or its errors would be of the wrong class."""
    code = """
try:
    import _interpreters as interpreters
except ImportError:
    import _xxsubinterpreters as interpreters
import calligraphy as cal
one = interpreters.create()
told = interpreters.run_string(one, '''
try:
    import calligraphy
except ImportError as error:
    told = str(error)
else:
    told = "nothing"
assert "main interpreter" in told, told
''')
assert told is None, told
interpreters.destroy(one)
try:
    cal.typical_stroke(40)
except cal.InvalidValue:
    print("as before")
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    if "No module named '_xxsubinterpreters'" in done.stderr:
        pytest.skip("this Python makes no interpreters")
    assert (done.returncode, done.stdout) == (0, "as before\n"), done.stderr
