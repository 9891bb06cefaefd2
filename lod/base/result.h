// Result<T>: a value, or one line saying what went wrong, where, and what was expected.
//
// For the outside world only (files, driver, command line). A programmer's mistake is a CHECK (check.h); a
// budget that runs out is neither, it is counted in the frame report.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "lod/base/check.h"

namespace lod {

/// One line for the user: what, where, expected. No trailing newline, no stop.
struct Error {
    std::string message;
};

/// Either a T or an Error.
template <typename T>
class [[nodiscard]] Result {
  public:
    Result(T value) : value_(std::move(value)) {}              // NOLINT: `return value;` is the point
    Result(Error error) : error_(std::move(error.message)) {}  // NOLINT: `return Error{...};` is the point

    explicit operator bool() const { return value_.has_value(); }

    /// The value; CHECKs that there is one.
    T& operator*() {
        CHECK(value_.has_value());
        return *value_;
    }
    const T& operator*() const {
        CHECK(value_.has_value());
        return *value_;
    }
    T* operator->() { return &**this; }
    const T* operator->() const { return &**this; }

    /// The error, to hand on to a caller with another T; CHECKs that there is one.
    Error error() const {
        CHECK(!value_.has_value());
        return Error{error_};
    }
    const std::string& message() const { return error_; }

  private:
    std::optional<T> value_;
    std::string error_;
};

/// The T of a Result that has nothing to return but success.
struct Ok {};

}  // namespace lod
