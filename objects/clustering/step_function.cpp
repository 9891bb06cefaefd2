#include "objects/clustering/step_function.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lod/base/check.h"

namespace objects {

namespace {

void append_step(double time_s, double value, StepFunction& out) {
    if (!out.time_s.empty() && out.time_s.back() == time_s) {
        out.value.back() = value;
        const size_t count = out.value.size();
        if (count > 1 && out.value[count - 2] == value) {
            out.time_s.pop_back();
            out.value.pop_back();
        }
    } else if (out.value.empty() || out.value.back() != value) {
        out.time_s.push_back(time_s);
        out.value.push_back(value);
    }
}

/// Goes through the steps of several functions at once.
class Sweep {
  public:
    explicit Sweep(std::span<const WeightedFunction> functions)
        : functions_(functions), at_(functions.size(), 0) {}

    /// The next instant at which any of them changes; infinity when none does any more.
    double next_s() const {
        double next = std::numeric_limits<double>::infinity();
        for (size_t i = 0; i < at_.size(); ++i) {
            const std::vector<double>& times = functions_[i].function->time_s;
            if (at_[i] + 1 < times.size()) next = std::min(next, times[at_[i] + 1]);
        }
        return next;
    }
    void advance_to(double time_s) {
        for (size_t i = 0; i < at_.size(); ++i) {
            const std::vector<double>& times = functions_[i].function->time_s;
            while (at_[i] + 1 < times.size() && times[at_[i] + 1] <= time_s)
                ++at_[i];
        }
    }
    double value(size_t i) const { return functions_[i].function->value[at_[i]]; }

  private:
    std::span<const WeightedFunction> functions_;
    std::vector<size_t> at_;
};

}  // namespace

StepFunction function_of(std::span<const data::TimeSpan> spans, double end_s, bool is_at_end) {
    StepFunction f;
    append_step(0.0, 0.0, f);
    for (const data::TimeSpan& span : spans) {
        append_step(span.begin_s, 1.0, f);
        if (span.end_s < end_s || !is_at_end) append_step(span.end_s, 0.0, f);
    }
    return f;
}

StepFunction weighted_mean(std::span<const WeightedFunction> functions) {
    CHECK(!functions.empty());
    double total = 0.0;
    for (const WeightedFunction& one : functions)
        total += one.weight;
    const bool count_alike = !(total > 0.0);
    if (count_alike) total = static_cast<double>(functions.size());
    Sweep sweep(functions);
    StepFunction mean;
    for (double time = 0.0; std::isfinite(time); time = sweep.next_s()) {
        sweep.advance_to(time);
        double sum = 0.0;
        bool are_all_0 = true, are_all_1 = true;
        for (size_t i = 0; i < functions.size(); ++i) {
            const double value = sweep.value(i);
            sum += (count_alike ? 1.0 : functions[i].weight) * value;
            are_all_0 = are_all_0 && value == 0.0;
            are_all_1 = are_all_1 && value == 1.0;
        }
        const double between = std::clamp(sum / total, 0x1p-52, 1.0 - 0x1p-52);
        append_step(time, are_all_0 ? 0.0 : (are_all_1 ? 1.0 : between), mean);
    }
    return mean;
}

StepFunction product(const StepFunction& a, const StepFunction& b) {
    const WeightedFunction both[] = {{&a, 1.0}, {&b, 1.0}};
    Sweep sweep(both);
    StepFunction out;
    for (double time = 0.0; std::isfinite(time); time = sweep.next_s()) {
        sweep.advance_to(time);
        append_step(time, sweep.value(0) * sweep.value(1), out);
    }
    return out;
}

StepFunction complement(const StepFunction& f) {
    StepFunction out = f;
    for (double& value : out.value)
        value = 1.0 - value;
    return out;
}

double distance(const StepFunction& a, const StepFunction& b, double end_s) {
    size_t i = 0, k = 0;
    double sum = 0.0, time = 0.0;
    while (time < end_s) {
        const double next_a = i + 1 < a.time_s.size() ? a.time_s[i + 1] : end_s;
        const double next_b = k + 1 < b.time_s.size() ? b.time_s[k + 1] : end_s;
        const double next = std::min({next_a, next_b, end_s});
        sum += std::abs(a.value[i] - b.value[k]) * (next - time);
        time = next;
        if (next_a <= time && i + 1 < a.time_s.size()) ++i;
        if (next_b <= time && k + 1 < b.time_s.size()) ++k;
    }
    return sum / end_s;
}

StepFunction coarsened(const StepFunction& f, double slack) {
    const auto is_between = [](double v) { return v > 0.0 && v < 1.0; };
    StepFunction out;
    for (size_t i = 0; i < f.value.size();) {
        double low = f.value[i], high = low;
        size_t next = i + 1;
        for (; is_between(f.value[i]) && next < f.value.size() && is_between(f.value[next]); ++next) {
            const double value = f.value[next];
            if ((value >= 0.5) != (low >= 0.5)) break;
            if (std::max(high, value) - std::min(low, value) > slack) break;
            low = std::min(low, value);
            high = std::max(high, value);
        }
        append_step(f.time_s[i], low >= 0.5 ? low : high, out);
        i = next;
    }
    return out;
}

MeanTimes mean_times(const StepFunction& f, double end_s) {
    double rise = f.value[0], fall = f.value.back(), rise_sum = 0.0, fall_sum = f.value.back() * end_s;
    for (size_t i = 1; i < f.value.size(); ++i) {
        const double change = f.value[i] - f.value[i - 1];
        (change > 0.0 ? rise : fall) += std::abs(change);
        (change > 0.0 ? rise_sum : fall_sum) += std::abs(change) * f.time_s[i];
    }
    MeanTimes times;
    times.rise_s = rise > 0.0 ? rise_sum / rise : end_s;
    times.fall_s = fall > 0.0 ? fall_sum / fall : end_s;
    return times;
}

}  // namespace objects
