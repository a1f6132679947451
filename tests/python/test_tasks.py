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

PROMISE = 0.1  # seconds from the request to the return
MOMENTS = 20


@pytest.fixture(scope="module")
def long_calls(long_mesh, sphere_model):
    """Name -> a call of some seconds, compress of many; each takes progress and cancel."""
    return {
        "compress": lambda **options: pfgeom.compress(*long_mesh, tolerance=3e-4, **options),
        "to_mesh": lambda **options: sphere_model.to_mesh(resolution=512, **options),
        "compare": lambda **options: pfgeom.compare(long_mesh, shapes.torus(), samples=1_000_000, **options),
    }


class Stopwatch:
    """Seconds since `start`: of the clock, or of the processor where that is less, as the machine may be busy."""

    def start(self):
        self._start = time.perf_counter(), time.process_time()

    def seconds(self) -> float:
        wall, processor = self._start
        return min(time.perf_counter() - wall, time.process_time() - processor)


def stopped_after(call, moment: float) -> float | None:
    """Cancel at that moment; seconds from there to the return, or None if the call was faster."""
    token = pfgeom.CancelToken()
    watch = Stopwatch()

    def cancel():
        watch.start()
        token.cancel()

    timer = threading.Timer(moment, cancel)
    timer.start()
    try:
        call(cancel=token, threads=1)
    except pfgeom.Cancelled:
        return watch.seconds()
    finally:
        timer.cancel()
    return None


@pytest.mark.parametrize("name", ["compress", "to_mesh", "compare"])
def test_cancel_at_random_moments(long_calls, name):
    moments = random.Random(4)
    delays = [stopped_after(long_calls[name], moments.uniform(0, 0.8)) for _ in range(MOMENTS)]
    stopped = [delay for delay in delays if delay is not None]
    assert len(stopped) >= MOMENTS // 2
    assert max(stopped) <= PROMISE


def test_token_that_is_set_already(long_calls):
    token = pfgeom.CancelToken()
    assert not token.cancelled
    token.cancel()
    assert token.cancelled
    watch = Stopwatch()
    watch.start()
    with pytest.raises(pfgeom.Cancelled):
        long_calls["compress"](cancel=token)
    assert watch.seconds() <= PROMISE


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

    watch = Stopwatch()

    def progress(fraction, stage):
        watch.start()
        raise Stop(stage)

    with pytest.raises(Stop):
        long_calls[name](progress=progress, threads=1)
    assert watch.seconds() <= PROMISE


@pytest.mark.parametrize("name", ["compress", "to_mesh"])
def test_interrupt_stops_the_call(long_calls, name):
    """As Ctrl-C does. The caller's own token stays as it is."""
    watch = Stopwatch()

    def interrupt():
        watch.start()
        signal.raise_signal(signal.SIGINT)

    token = pfgeom.CancelToken()
    timer = threading.Timer(0.3, interrupt)
    timer.start()
    try:
        with pytest.raises(KeyboardInterrupt):
            long_calls[name](cancel=token, threads=1)
    finally:
        timer.cancel()
    assert watch.seconds() <= PROMISE
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
