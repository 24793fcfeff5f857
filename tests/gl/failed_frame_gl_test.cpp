#include <gtest/gtest.h>

#include "bench/common/stage.h"
#include "bench/frame/frame_times.h"
#include "tests/gl/failing_gl.h"

/// A frame that the device does not draw must end a measurement: its times would be those of nothing.
namespace gnomon {
namespace {

TEST(FailedFrames, AreNotTimed) {
    bench::StageOptions options;
    options.size_px = {64, 48};
    auto stage = bench::Stage::open(options);
    ASSERT_TRUE(stage) << to_line(stage.error());
    stage.value()->run_frame();  // calls everything that is to fail
    EXPECT_GT(bench::measure_frame_times(*stage.value(), 1, 1).kept.us.median, 0.0);
    FailingGl driver;
    driver.begin(GlFault::link_failed, 0, true);
    auto other = bench::Stage::open(options);
    ASSERT_TRUE(other) << to_line(other.error());
    EXPECT_THROW(bench::measure_frame_times(*other.value(), 1, 1), bench::FailedFrame);
    driver.end();
}

}  // namespace
}  // namespace gnomon
