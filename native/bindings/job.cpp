#include "job.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <string>
#include <thread>

namespace py = pybind11;

namespace pfgeom::bindings {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

/// Ctrl-C and a set token reach the work within this time; the work itself polls every 10 ms or so, and the
/// promise is 100 ms in all.
constexpr milliseconds kPoll{20};
/// At most 20 progress calls a second.
constexpr milliseconds kProgressInterval{50};

/// What the two threads share.
class Board {
  public:
    void post(double fraction, std::string_view stage) {
        const std::lock_guard lock(mutex_);
        fraction_ = fraction;
        stage_ = stage;
        fresh_ = true;
    }
    void finish(std::exception_ptr failure) {
        const std::lock_guard lock(mutex_);
        failure_ = failure;
        finished_ = true;
        changed_.notify_one();
    }
    bool wait_finished(milliseconds limit) {
        std::unique_lock lock(mutex_);
        return changed_.wait_for(lock, limit, [this] { return finished_; });
    }
    /// The newest report that has not been taken yet.
    std::optional<std::pair<double, std::string>> take() {
        const std::lock_guard lock(mutex_);
        if (!fresh_) return std::nullopt;
        fresh_ = false;
        return std::pair(fraction_, stage_);
    }
    std::exception_ptr failure() const { return failure_; }  ///< once finished

  private:
    std::mutex mutex_;
    std::condition_variable changed_;
    double fraction_ = 0;
    std::string stage_;
    bool fresh_ = false, finished_ = false;
    std::exception_ptr failure_;
};

/// The calling thread's part: signals and progress, with the interpreter's lock.
class Watcher {
  public:
    Watcher(Board& board, const py::object& progress) : board_(board), progress_(progress) {}

    void poll() {
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        if (Clock::now() - last_ >= kProgressInterval) deliver();
    }
    void deliver() {
        if (progress_.is_none()) return;
        const auto report = board_.take();
        if (!report) return;
        last_ = Clock::now();
        progress_(report->first, report->second);
    }

  private:
    Board& board_;
    const py::object& progress_;
    Clock::time_point last_ = Clock::now();
};

}  // namespace

Job::Job(int threads, py::object progress, const CancelToken* cancel)
    : threads_(threads), progress_(std::move(progress)), cancel_(cancel) {
    if (threads < 0) throw InvalidInput("threads must be 0 (all) or more");
    if (!progress_.is_none() && !PyCallable_Check(progress_.ptr()))
        throw py::type_error("progress must be callable");
}

void Job::watch(const std::function<void(const Task&)>& work) {
    Board board;
    CancelToken stop;  // the work's own: an exception here must not mark the caller's token
    const Task task{threads_, &stop, [&board](double f, std::string_view stage) { board.post(f, stage); }};
    Watcher watcher(board, progress_);
    std::exception_ptr interruption;  // what Python raised while the work ran

    if (cancel_ && cancel_->cancelled()) throw Cancelled();
    {
        const py::gil_scoped_release unlocked;
        std::thread worker([&] {
            try {
                work(task);
                board.finish(nullptr);
            } catch (...) {
                board.finish(std::current_exception());
            }
        });
        while (!board.wait_finished(kPoll)) {
            if (cancel_ && cancel_->cancelled()) stop.cancel();
            if (stop.cancelled()) continue;
            const py::gil_scoped_acquire locked;
            try {
                watcher.poll();
            } catch (...) {
                interruption = std::current_exception();
                stop.cancel();
            }
        }
        worker.join();
    }
    if (interruption) std::rethrow_exception(interruption);
    if (board.failure()) std::rethrow_exception(board.failure());
    watcher.deliver();
}

}  // namespace pfgeom::bindings
