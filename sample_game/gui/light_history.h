#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "gnomon/frame.h"

/// Time and predicted error of each light's shadow over the last frames.
namespace gnomon::game {

/// One frame of one light. No error: it has no shadow. No GPU time: it was not measured in that frame.
struct LightSample {
    std::optional<float> gpu_ms = {}, error_px = {};
    float cpu_ms = 0.0f;
};

/// The last samples of a light, oldest first.
class LightLine {
public:
    static constexpr std::size_t kFrames = 240;

    explicit LightLine(std::string name) : name_(std::move(name)) {}
    void add(const LightSample& sample) { samples_[count_++ % kFrames] = sample; }

    const std::string& name() const { return name_; }
    std::size_t size() const { return count_ < kFrames ? count_ : kFrames; }
    /// Returns a kept sample; 0 is the oldest.
    const LightSample& operator[](std::size_t i) const {
        return samples_[count_ < kFrames ? i : (count_ + i) % kFrames];
    }
    const LightSample& latest() const { return (*this)[size() - 1]; }

    /// Returns the median GPU time of the kept samples; empty: none has one.
    std::optional<float> median_gpu_ms() const;

private:
    std::string name_;
    std::array<LightSample, kFrames> samples_ = {};
    std::size_t count_ = 0;
};

class LightGraph {
public:
    /// Adds a sample to the line of each light of the report. Drops the lines of other lights.
    void add(const FrameReport& report);
    void clear() { lines_.clear(); }
    const std::vector<LightLine>& lines() const { return lines_; }
    /// Returns the largest kept time, as most_error_px() does the largest error. 0: there is none.
    float most_ms() const;
    float most_error_px() const;

private:
    std::vector<LightLine> lines_;
};

/// Returns the median: the middle value, or the lower one of the two in the middle. Empty: there is no value.
std::optional<float> median(std::vector<float> values);

}  // namespace gnomon::game
