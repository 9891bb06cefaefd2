// ShortList: a list that is nearly always short. The first few values lie in the list itself, so that reading them costs
// no second look into memory; more go to the heap.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

namespace lod {

/// Value: trivially copyable, at most eight bytes aligned. sizeof: 8 + kInside values, in whole pointers.
template <typename Value, uint32_t kInside>
class ShortList {
    static_assert(std::is_trivially_copyable_v<Value> && alignof(Value) <= alignof(Value*));
    static_assert(kInside * sizeof(Value) >= sizeof(Value*));

  public:
    ShortList() = default;
    ShortList(ShortList&& other) noexcept : size_(other.size_), capacity_(other.capacity_) {
        std::memcpy(&store_, &other.store_, sizeof(store_));
        other.size_ = 0;
        other.capacity_ = kInside;
    }
    ShortList& operator=(ShortList&& other) noexcept {
        std::swap(size_, other.size_);
        std::swap(capacity_, other.capacity_);
        std::swap(store_, other.store_);
        return *this;
    }
    ~ShortList() {
        if (capacity_ != kInside) delete[] store_.heap;
    }

    uint32_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    Value* begin() { return capacity_ == kInside ? store_.inside : store_.heap; }
    const Value* begin() const { return capacity_ == kInside ? store_.inside : store_.heap; }
    Value* end() { return begin() + size_; }
    const Value* end() const { return begin() + size_; }
    const Value& operator[](size_t i) const { return begin()[i]; }
    const Value& back() const { return begin()[size_ - 1]; }

    void clear() { size_ = 0; }
    void pop_back() { --size_; }
    void push_back(Value value) {
        if (size_ == capacity_) grow(size_ + 1);
        begin()[size_++] = value;
    }
    /// @param from, to  not of this list
    void assign(const Value* from, const Value* to) {
        const auto count = static_cast<uint32_t>(to - from);
        size_ = 0;
        if (count > capacity_) grow(count);
        std::copy(from, to, begin());
        size_ = count;
    }
    /// Takes out every such value.
    void erase(const Value& value) {
        size_ = static_cast<uint32_t>(std::remove(begin(), end(), value) - begin());
    }

  private:
    void grow(uint32_t least) {
        const uint32_t capacity = std::max(least, 2 * capacity_);
        auto* heap = new Value[capacity];
        std::copy(begin(), end(), heap);
        if (capacity_ != kInside) delete[] store_.heap;
        store_.heap = heap;
        capacity_ = capacity;
    }

    uint32_t size_ = 0, capacity_ = kInside;
    union Store {
        Value inside[kInside];
        Value* heap;
    } store_;
};

}  // namespace lod
