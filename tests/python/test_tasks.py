"""Long calls: progress, cancelling, exceptions, Ctrl-C, and other threads meanwhile."""

from __future__ import annotations

import random
import signal
import threading
import time
from functools import partial

import pfgeom
import pytest
import shapes

PROMISE = 0.1  # seconds from cancel to return
MOMENTS = 20


@pytest.fixture(scope="module")
def long_calls(long_mesh, torus_model):
    """Name -> a call of some seconds, compress of many; each takes progress and cancel."""
    return {
        "compress": lambda **options: pfgeom.compress(*long_mesh, tolerance=3e-4, **options),
        "to_mesh": lambda **options: torus_model.to_mesh(resolution=512, **options),
        "compare": lambda **options: pfgeom.compare(long_mesh, shapes.torus(), samples=4_000_000, **options),
    }


def stopped_after(call, seconds: float) -> float | None:
    """Cancel after that time; seconds from there to the return, or None if the call was faster."""
    token = pfgeom.CancelToken()
    cancelled_at = []

    def cancel():
        cancelled_at.append(time.perf_counter())
        token.cancel()

    timer = threading.Timer(seconds, cancel)
    timer.start()
    try:
        call(cancel=token)
    except pfgeom.Cancelled:
        return time.perf_counter() - cancelled_at[0]
    finally:
        timer.cancel()
    return None


@pytest.mark.parametrize("name", ["compress", "to_mesh", "compare"])
def test_cancel_at_random_moments(long_calls, name):
    """A moment counts as late when it is late three times: the machine may be busy with something else."""
    moments = random.Random(4)
    stopped = 0
    for _ in range(MOMENTS):
        moment = moments.uniform(0, 0.8)
        delay = stopped_after(long_calls[name], moment)
        for _ in range(2):
            if delay is not None and delay > PROMISE:
                delay = stopped_after(long_calls[name], moment)
        assert delay is None or delay <= PROMISE
        stopped += delay is not None
    assert stopped >= MOMENTS // 2


def test_token_that_is_set_already(long_calls):
    token = pfgeom.CancelToken()
    assert not token.cancelled
    token.cancel()
    assert token.cancelled
    start = time.perf_counter()
    with pytest.raises(pfgeom.Cancelled):
        long_calls["compress"](cancel=token)
    assert time.perf_counter() - start < PROMISE


@pytest.mark.parametrize("name", ["compress", "to_mesh"])
def test_progress_rises_at_a_modest_rate_in_this_thread(long_calls, name):
    whole_calls = {**long_calls, "compress": partial(pfgeom.compress, *shapes.torus(), tolerance=1e-2)}
    calls = []
    start = time.perf_counter()
    whole_calls[name](progress=lambda *report: calls.append((*report, threading.get_ident())))
    seconds = time.perf_counter() - start
    fractions = [fraction for fraction, _, _ in calls]
    assert fractions == sorted(fractions)
    assert all(0 <= fraction <= 1 for fraction in fractions)
    assert all(isinstance(stage, str) and stage for _, stage, _ in calls)
    assert {thread for _, _, thread in calls} == {threading.get_ident()}
    assert 3 <= len(calls) <= 20 * seconds + 1


@pytest.mark.parametrize("name", ["compress", "to_mesh"])
def test_exception_in_progress_stops_the_call(long_calls, name):
    class Stop(Exception):
        pass

    raised_at = []

    def progress(fraction, stage):
        raised_at.append(time.perf_counter())
        raise Stop(stage)

    with pytest.raises(Stop):
        long_calls[name](progress=progress)
    assert len(raised_at) == 1
    assert time.perf_counter() - raised_at[0] < 2 * PROMISE


@pytest.mark.parametrize("name", ["compress", "to_mesh"])
def test_interrupt_stops_the_call(long_calls, name):
    """As Ctrl-C does. The caller's own token stays as it is."""
    sent_at = []

    def interrupt():
        sent_at.append(time.perf_counter())
        signal.raise_signal(signal.SIGINT)

    token = pfgeom.CancelToken()
    timer = threading.Timer(0.3, interrupt)
    timer.start()
    try:
        with pytest.raises(KeyboardInterrupt):
            long_calls[name](cancel=token)
    finally:
        timer.cancel()
    assert time.perf_counter() - sent_at[0] < 2 * PROMISE
    assert not token.cancelled


def test_other_threads_run_meanwhile(long_calls):
    """The interpreter's lock is released: a second thread counts on while the call works."""
    counted = 0
    done = threading.Event()

    def count():
        nonlocal counted
        while not done.wait(0.01):
            counted += 1

    thread = threading.Thread(target=count)
    thread.start()
    start = time.perf_counter()
    long_calls["to_mesh"](threads=1)
    seconds = time.perf_counter() - start
    done.set()
    thread.join()
    assert counted >= 20 * seconds


def test_one_model_in_many_threads(torus_model):
    """The field is built at the first query, whoever asks first."""
    model = pfgeom.from_bytes(torus_model.to_bytes())
    values = []
    threads = [threading.Thread(target=lambda: values.append(float(model([1.0, 0, 0])))) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert values == [float(torus_model([1.0, 0, 0]))] * 8
