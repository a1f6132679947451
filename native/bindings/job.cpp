#include "job.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace py = pybind11;

namespace pfgeom::bindings {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

/// Ctrl-C and a set token reach the work within this time.
constexpr milliseconds kPoll{20};
/// From there on, how long the work may take to its next poll before it is left. Together less than 100 ms.
constexpr milliseconds kPatience{60};
/// At most 20 progress calls a second.
constexpr milliseconds kProgressInterval{50};

/// What the two threads share.
class Board {
  public:
    void post(double fraction, std::string_view stage) {
        const std::lock_guard lock(mutex_);
        fraction_ = std::max(fraction_, fraction);  // a second try may start lower; what is shown never falls
        stage_ = stage;
        fresh_ = true;
    }
    void finish(std::exception_ptr failure) {
        const std::lock_guard lock(mutex_);
        failure_ = std::move(failure);
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

/// One piece of work and its thread.
class Worker {
  public:
    Worker(int threads, std::function<void(const Task&)> work)
        : shared_(std::make_shared<Shared>(std::move(work))), thread_([shared = shared_, threads] {
              const auto post = [&shared](double f, std::string_view stage) { shared->board.post(f, stage); };
              try {
                  shared->work(Task{threads, &shared->stop, post});
                  shared->board.finish(nullptr);
              } catch (...) {
                  shared->board.finish(std::current_exception());
              }
          }) {}

    Board& board() { return shared_->board; }
    bool stopping() const { return shared_->stop.cancelled(); }
    bool overdue() const { return stopping() && Clock::now() - stopped_ > kPatience; }
    void stop() {
        if (!stopping()) stopped_ = Clock::now();
        shared_->stop.cancel();
    }
    void join() { thread_.join(); }

  private:
    struct Shared {
        explicit Shared(std::function<void(const Task&)> w) : work(std::move(w)) {}
        std::function<void(const Task&)> work;
        CancelToken stop;  // the work's own: an exception must not mark the caller's token
        Board board;
    };
    std::shared_ptr<Shared> shared_;
    std::thread thread_;
    Clock::time_point stopped_;
};

/// Work that was left and has not come to its end, as far as anybody has looked.
class Stragglers {
  public:
    void add(Worker worker) {
        const std::lock_guard lock(mutex_);
        std::erase_if(workers_, [](Worker& w) {
            const bool finished = w.board().wait_finished(milliseconds{0});
            if (finished) w.join();
            return finished;
        });
        workers_.push_back(std::move(worker));
    }
    void join_all() {
        const std::lock_guard lock(mutex_);
        for (Worker& worker : workers_) worker.join();
        workers_.clear();
    }

  private:
    std::mutex mutex_;
    std::vector<Worker> workers_;
};

Stragglers& stragglers() {
    static Stragglers all;
    return all;
}

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
    if (!progress_.is_none() && !PyCallable_Check(progress_.ptr())) {
        throw py::type_error("progress must be callable");
    }
}

void Job::watch(std::function<void(const Task&)> work) {
    if (cancel_ && cancel_->cancelled()) throw Cancelled();
    Worker worker(threads_, std::move(work));
    Watcher watcher(worker.board(), progress_);
    std::exception_ptr interruption;  // what Python raised while the work ran
    bool finished = false;
    {
        const py::gil_scoped_release unlocked;
        while (!(finished = worker.board().wait_finished(kPoll)) && !worker.overdue()) {
            if (cancel_ && cancel_->cancelled()) worker.stop();
            if (worker.stopping()) continue;
            const py::gil_scoped_acquire locked;
            try {
                watcher.poll();
            } catch (...) {
                interruption = std::current_exception();
                worker.stop();
            }
        }
        if (finished) worker.join();
    }
    const std::exception_ptr failure = finished ? worker.board().failure() : nullptr;
    if (!finished) stragglers().add(std::move(worker));
    if (interruption) std::rethrow_exception(interruption);
    if (!finished) throw Cancelled();
    if (failure) std::rethrow_exception(failure);
    watcher.deliver();
}

void Job::wait_for_stragglers() {
    const py::gil_scoped_release unlocked;
    stragglers().join_all();
}

}  // namespace pfgeom::bindings
