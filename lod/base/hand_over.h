// HandOver: values from one thread to another, in their order. The taker waits for them, the giver for nobody.
#pragma once

#include <condition_variable>
#include <mutex>
#include <utility>
#include <vector>

namespace lod {

template <typename Value>
class HandOver {
  public:
    void give(Value value) {
        {
            const std::lock_guard lock(mutex_);
            given_.push_back(std::move(value));
        }
        is_given_.notify_one();
    }
    /// Nothing more will come.
    void close() {
        {
            const std::lock_guard lock(mutex_);
            is_closed_ = true;
        }
        is_given_.notify_one();
    }
    /// All that is there, once there is something; nothing: closed and all taken.
    std::vector<Value> take() {
        std::unique_lock lock(mutex_);
        is_given_.wait(lock, [this] { return is_closed_ || !given_.empty(); });
        return std::exchange(given_, {});
    }

  private:
    std::mutex mutex_;
    std::condition_variable is_given_;
    std::vector<Value> given_;
    bool is_closed_ = false;
};

}  // namespace lod
