// StepFunction: how much of something is there, from 0 to T: a value that changes at instants only.
//
// Everything about them is exact: sums over few functions are formed anew at every step, integrals are sums of products.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "data/scene_time.h"

namespace objects {

/// From time_s[i] to the next step, or to T, the value is value[i].
struct StepFunction {
    std::vector<double> time_s;  ///< rises strictly; the first is 0
    std::vector<double> value;   ///< 0 … 1; neighbours differ

    bool operator==(const StepFunction&) const = default;
};

/// The function that is 1 in the spans and 0 outside.
/// @param spans      in order, none touching another (data::visible_spans)
/// @param is_at_end  the value at T itself, which a span that ends there does not tell
StepFunction function_of(std::span<const data::TimeSpan> spans, double end_s, bool is_at_end);

/// One of the functions a mean is made of.
struct WeightedFunction {
    const StepFunction* function = nullptr;
    double weight = 0.0;  ///< >= 0; when all are 0 they count alike
};

/// Weighted mean. Exactly 0 (1) where all are, strictly between elsewhere.
/// Cost: O(steps * functions).
StepFunction weighted_mean(std::span<const WeightedFunction> functions);

/// Value by value; of functions that are 0 or 1 what both have in common.
StepFunction product(const StepFunction& a, const StepFunction& b);

/// 1 - f.
StepFunction complement(const StepFunction& f);

/// (1/T) * integral of |a - b| over [0, T]: D_V of the source.
double distance(const StepFunction& a, const StepFunction& b, double end_s);

/// Fewer steps, never less wrong: neighbours strictly between 0 and 1, on the same side of 1/2 and no more than
/// `slack` apart, take the value nearest to 1/2. Where the function is 0, 1, below 1/2 or not stays as it is, so what is
/// drawn stays, and min(v, 1 - v), the share that is drawn wrongly, can only be overstated.
StepFunction coarsened(const StepFunction& f, double slack);

/// Where it rises and where it falls, weighted by how much: two numbers whose differences between functions of one span
/// each add up to T * distance.
struct MeanTimes {
    double rise_s = 0.0, fall_s = 0.0;
};
MeanTimes mean_times(const StepFunction& f, double end_s);

}  // namespace objects
