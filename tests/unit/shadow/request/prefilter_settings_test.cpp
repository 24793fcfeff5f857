#include "systems/shadow/request/prefilter_settings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "systems/shadow/request/filter_settings.h"
#include "systems/shadow/request/filter_table.h"
#include "tests/unit/shadow/shaders/glsl_in_float.h"

// The filters' own text, in floats, on moments that are rounded as their formats round them.
namespace gnomon::shadow {
namespace {

using glsl_in_float::vec4;

namespace shader {
using namespace glsl_in_float;
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#ifdef __clang__
#pragma clang diagnostic ignored "-Wkeyword-macro"
#endif
#define float Real
struct Exponential {
#include "shaders/shadow/filters/prefiltered/exponential.glsl"
};
struct Vsm {
#include "shaders/shadow/filters/prefiltered/vsm.glsl"
};
struct Evsm2 {
#include "shaders/shadow/filters/prefiltered/evsm2.glsl"
};
struct Evsm4 {
#include "shaders/shadow/filters/prefiltered/evsm4.glsl"
};
struct Moments {
#include "shaders/shadow/filters/prefiltered/moments.glsl"
};
#undef float
#pragma GCC diagnostic pop
}  // namespace shader

struct Surface {
    double share;   // depth as a share of the range
    double weight;  // share of the blurred texels
};

LightItem tuned(const ShadowTuning::Moments& moments) {
    LightItem light;
    light.tuning.moments = moments;
    return light;
}

/// One filter in one format.
class Store {
public:
    virtual ~Store() = default;
    Store(ShadowFilter filter, std::uint32_t bits, float exponent = 0.0f, float negative = 0.0f)
        : demand_(prefilter_settings(filter_row(filter),
                                tuned({.bits = bits, .exponent = exponent, .negative_exponent = negative}), 1024)) {}

    /// Returns what is stored of these surfaces: the blurred sum of their moments, each step rounded to the format.
    vec4 stored(const std::vector<Surface>& surfaces) const {
        vec4 sum;
        for (const Surface& surface : surfaces) {
            const vec4 one = rounded(moments_of(surface.share));
            for_each(sum, one, [&](float& a, float b) { a += static_cast<float>(surface.weight) * b; });
        }
        return rounded(sum);
    }
    float lit(const std::vector<Surface>& surfaces, double share) const { return lit(stored(surfaces), share); }
    virtual float lit(const vec4& moments, double share) const = 0;
    virtual vec4 moments_of(double share) const = 0;
    const PrefilterSettings& demand() const { return demand_; }
    vec4 settings() const { return {demand_.settings.x, demand_.settings.y, demand_.settings.z, demand_.settings.w}; }

    template <class Use>
    static void for_each(vec4& a, const vec4& b, Use use) {
        use(a.x.value, b.x.value);
        use(a.y.value, b.y.value);
        use(a.z.value, b.z.value);
        use(a.w.value, b.w.value);
    }
    vec4 rounded(vec4 moments) const {
        for_each(moments, moments, [&](float& a, float) { a = rounded(a); });
        return moments;
    }

private:
    float rounded(float value) const {
        using gl::Format;
        const Format format = demand_.format;
        if (format == Format::r16f || format == Format::rg16f || format == Format::rgba16f)
            return glm::unpackHalf1x16(glm::packHalf1x16(value));
        if (format == Format::rg16 || format == Format::rgba16)
            return std::round(std::clamp(value, 0.0f, 1.0f) * 65535.0f) / 65535.0f;
        return value;
    }
    PrefilterSettings demand_;
};

template <class Shader, ShadowFilter kFilter>
struct Of final : Store {
    explicit Of(std::uint32_t bits, float exponent = 0.0f, float negative = 0.0f) : Store(kFilter, bits, exponent, negative) {}
    float lit(const vec4& moments, double share) const override { return shader_.moments_lit(moments, share, settings()).value; }
    vec4 moments_of(double share) const override { return shader_.moments_of(share, settings()); }
    mutable Shader shader_;
};

std::vector<std::unique_ptr<Store>> stores() {
    std::vector<std::unique_ptr<Store>> all;
    for (const std::uint32_t bits : {16u, 32u}) {
        for (const float exponent : {0.0f, 0.01f, 1.0f, 1e6f}) {
            all.push_back(std::make_unique<Of<shader::Exponential, ShadowFilter::exponential>>(bits, exponent));
            all.push_back(std::make_unique<Of<shader::Evsm2, ShadowFilter::evsm2>>(bits, exponent));
            all.push_back(std::make_unique<Of<shader::Evsm4, ShadowFilter::evsm4>>(bits, exponent, exponent));
        }
        all.push_back(std::make_unique<Of<shader::Vsm, ShadowFilter::vsm>>(bits));
        all.push_back(std::make_unique<Of<shader::Moments, ShadowFilter::moments>>(bits));
    }
    return all;
}

std::string name_of(const Store& store) {
    return std::string(gl::to_text(store.demand().format)) + ", exponents " + std::to_string(store.demand().settings.x) + " " +
           std::to_string(store.demand().settings.y);
}

constexpr double kNone = 1e-2;  // "within 1 %"

TEST(Moments, OfAnyDistanceAreFiniteInTheirFormatAndSoAreTheirSums) {
    for (const auto& store : stores())
        for (const double share : {0.0, 1e-7, 0.25, 0.5, 0.75, 1.0 - 1e-7, 1.0}) {
            vec4 moments = store->stored({{share, 0.5}, {1.0, 0.5}});
            Store::for_each(moments, moments, [&](float a, float) { EXPECT_TRUE(std::isfinite(a)) << name_of(*store) << " at " << share; });
        }
}

TEST(Moments, WouldOverflowHalfFloatsBeyondTheExponentThatIsTaken) {
    const Of<shader::Evsm2, ShadowFilter::evsm2> most(16, 1e6f);
    EXPECT_TRUE(most.demand().cut);
    const float exponent = most.demand().settings.x;
    EXPECT_LE(std::exp(2.0f * exponent), 65504.0f);
    EXPECT_GT(std::exp(2.0f * exponent * 1.01f), 65504.0f) << "less than the format bears";
    const Of<shader::Evsm4, ShadowFilter::evsm4> whole(32, 1e6f);
    EXPECT_LE(std::exp(2.0 * static_cast<double>(whole.demand().settings.x)), static_cast<double>(std::numeric_limits<float>::max()) / 100.0);
}

TEST(Moments, OfAnySurfacesGiveAShareAtAnyPlace) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    constexpr int kRounds = 4000;
    for (const auto& store : stores())
        for (int round = 0; round < kRounds; ++round) {
            std::vector<Surface> surfaces;
            const std::size_t count = 1 + random() % 9;
            // Some lie on each other, or at the ends of the range.
            for (std::size_t i = 0; i < count; ++i) {
                const double at = random() % 4 == 0 ? std::round(share(random)) : share(random);
                surfaces.push_back({i > 0 && random() % 4 == 0 ? surfaces[0].share : at, 1.0 / static_cast<double>(count)});
            }
            for (const double at : {0.0, surfaces[0].share, share(random), 1.0}) {
                const float lit = store->lit(surfaces, at);
                ASSERT_TRUE(lit >= 0.0f && lit <= 1.0f) << name_of(*store) << ": " << lit << " at " << at << ", first of " << count << " at " << surfaces[0].share;
            }
        }
}

TEST(Moments, OfWhatNobodyStoredGiveAShareToo) {
    std::mt19937_64 random(6);
    std::uniform_real_distribution<float> any(-2.0f, 2.0f);
    for (const auto& store : stores())
        for (int round = 0; round < 2000; ++round) {
            const vec4 moments(any(random), any(random), any(random), any(random));
            const float lit = store->lit(moments, 0.5 + 0.25 * static_cast<double>(any(random)));
            EXPECT_FALSE(std::isnan(lit)) << name_of(*store);
        }
}

TEST(Moments, OfOneSurfaceDarkenWhatIsBehindItAndNothingBefore) {
    for (const auto& store : stores()) {
        const double exponent = static_cast<double>(store->demand().settings.x);
        if (exponent > 0.0 && exponent < 5.0) continue;  // set for so little contrast
        // How far behind it is dark: what rounding hides, a tenth of it being one percent; of one exponential, its own width.
        double clear = 10.0 * std::sqrt(static_cast<double>(store->demand().settings.z));
        if (exponent > 0.0) clear = std::max(clear, 5.0) / (2.0 * exponent);
        for (const double at : {0.0, 0.2, 0.5, 0.7}) {
            EXPECT_GE(store->lit({{at, 1.0}}, at), 1.0 - kNone) << name_of(*store) << " on it, at " << at;
            EXPECT_GE(store->lit({{at, 1.0}}, 0.5 * at), 1.0 - kNone) << name_of(*store) << " before it";
            if (at + clear > 1.0) continue;
            EXPECT_LE(store->lit({{at, 1.0}}, at + clear), kNone) << name_of(*store) << " behind it, at " << at << " + " << clear;
            EXPECT_LE(store->lit({{at, 1.0}}, 1.0), kNone) << name_of(*store) << " far behind it";
        }
    }
}

TEST(Moments, NeverDarkenMoreThanWhatIsNearer) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (const auto& store : stores())
        for (int round = 0; round < 2000; ++round) {
            std::vector<Surface> surfaces;
            for (int i = 0; i < 6; ++i) surfaces.push_back({share(random), 1.0 / 6.0});
            const double at = share(random);
            double not_nearer = 0.0;
            for (const Surface& s : surfaces) not_nearer += s.share >= at ? s.weight : 0.0;
            // Rounded moments are those of surfaces somewhat aside.
            EXPECT_GE(store->lit(surfaces, at), not_nearer - 0.05) << name_of(*store);
        }
}

TEST(Moments, OfACasterBeforeTheReceiverGiveItsShare) {
    for (const auto& store : stores()) {
        // An exponential needs contrast, and 16 bits hide what little there is.
        const bool single = store->demand().format == gl::Format::r32f || store->demand().format == gl::Format::r16f;
        const float least = single ? 5.0f : 1.0f;
        if (store->demand().settings.x > 0.0f && store->demand().settings.x < least) continue;
        for (const double covered : {0.1, 0.25, 0.5, 0.75, 0.9})
            EXPECT_NEAR(store->lit({{0.2, covered}, {0.8, 1.0 - covered}}, 0.8), 1.0 - covered, 0.03) << name_of(*store);
    }
}

/// Returns the most that two casters, one over the other's inside, let through; truth: 0.
float worst_bleeding(const Store& store, double first, double second, double receiver) {
    float worst = 0.0f;
    for (double covered = 0.02; covered < 1.0; covered += 0.02)
        worst = std::max(worst, store.lit({{first, covered}, {second, 1.0 - covered}}, receiver));
    return worst;
}

// docs/explanation/prefiltered_maps.md states these.
TEST(Moments, OfTwoCastersBleedNoMoreThanStated) {
    const double first = 0.1, second = 0.6, receiver = 0.85;
    const double x = second - first, y = receiver - second;
    const double of_variance = x * x / (x * x + 4.0 * y * (x + y));
    const Of<shader::Vsm, ShadowFilter::vsm> variance(32);
    EXPECT_NEAR(worst_bleeding(variance, first, second, receiver), of_variance, 0.01);
    EXPECT_GT(of_variance, 0.2) << "nothing to be seen";
    EXPECT_LE(worst_bleeding(Of<shader::Exponential, ShadowFilter::exponential>(32), first, second, receiver), 0.01f);
    EXPECT_LE(worst_bleeding(Of<shader::Evsm2, ShadowFilter::evsm2>(32), first, second, receiver), 0.01f);
    EXPECT_LE(worst_bleeding(Of<shader::Evsm4, ShadowFilter::evsm4>(32), first, second, receiver), 0.01f);
    EXPECT_LE(worst_bleeding(Of<shader::Moments, ShadowFilter::moments>(32), first, second, receiver), 0.01f);
    EXPECT_LE(worst_bleeding(Of<shader::Evsm2, ShadowFilter::evsm2>(16), first, second, receiver), 0.04f);
    EXPECT_LE(worst_bleeding(Of<shader::Evsm4, ShadowFilter::evsm4>(16), first, second, receiver), 0.04f);
    EXPECT_LE(worst_bleeding(Of<shader::Moments, ShadowFilter::moments>(16), first, second, receiver), 0.04f);
}

TEST(Moments, InSixteenBitsAreUnpackedAsTheyWerePacked) {
    shader::Moments shader;
    std::mt19937_64 random(8);
    std::uniform_real_distribution<float> any(-1.0f, 1.0f);
    for (int round = 0; round < 1000; ++round) {
        const float s = any(random);
        vec4 powers(s, s * s, s * s * s, s * s * s * s), packed = shader.packed_moments(powers);
        Store::for_each(packed, packed, [&](float a, float) { EXPECT_TRUE(a >= -1e-6f && a <= 1.0f + 1e-6f) << a << " of " << s; });
        vec4 back = shader.unpacked_moments(packed);
        Store::for_each(back, powers, [&](float a, float b) { EXPECT_NEAR(a, b, 1e-6f); });
    }
}

TEST(PrefilterSettings, CutsWhatIsAbsurdAndSaysSo) {
    const FilterRow& evsm4 = filter_row(ShadowFilter::evsm4);
    const PrefilterSettings usual = prefilter_settings(evsm4, {}, 1024);
    EXPECT_FALSE(usual.cut);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const ShadowTuning::Moments absurd[] = {
        {.bits = 24},      {.exponent = nan},  {.exponent = -1.0f}, {.exponent = 43.0f}, {.negative_exponent = nan},
        {.bleeding = nan}, {.bleeding = 1.0f}, {.levels = 0},       {.levels = 5},       {.anisotropy = 0},
        {.anisotropy = 17}};
    for (const ShadowTuning::Moments& moments : absurd) {
        const PrefilterSettings demand = prefilter_settings(evsm4, tuned(moments), 1024);
        EXPECT_TRUE(demand.cut);
        EXPECT_TRUE(demand.settings.x > 0.0f && demand.settings.x <= 42.0f);
        EXPECT_TRUE(demand.settings.y > 0.0f && demand.settings.y <= 42.0f);
        EXPECT_TRUE(demand.bleeding >= 0.0f && demand.bleeding <= kMostMomentBleeding);
        EXPECT_TRUE(demand.levels >= 1 && demand.levels <= kMostMomentLevels);
        EXPECT_TRUE(demand.anisotropy >= 1 && demand.anisotropy <= kMostMomentAnisotropy);
    }
    EXPECT_EQ(prefilter_settings(filter_row(ShadowFilter::hard), tuned(absurd[0]), 1024), PrefilterSettings{})
        << "not its business";
}

TEST(PrefilterSettings, WidensTheFilterByWhatAPixelMayCoverAndFitsTheMap) {
    const FilterRow& vsm = filter_row(ShadowFilter::vsm);
    const LightItem widest = tuned({.levels = kMostMomentLevels, .anisotropy = kMostMomentAnisotropy});
    EXPECT_EQ(prefilter_settings(vsm, {}, 1024).reach_texel, 0.0f);
    const float reach = prefilter_settings(vsm, widest, 1024).reach_texel;
    EXPECT_GE(reach, 1.5f * 8.0f - 1.0f + 0.5f * 16.0f);
    EXPECT_EQ(filter_settings(vsm, widest, 1024).widest_texel, filter_settings(vsm, {}, 1024).widest_texel + reach);
    for (const std::uint32_t size : {16u, 64u, 128u}) {
        const PrefilterSettings small = prefilter_settings(vsm, widest, size);
        EXPECT_LE(small.reach_texel, static_cast<float>(size) / kEdgesPerSpread);
        EXPECT_TRUE(small.cut);
    }
}

TEST(PrefilterSettings, HasALevelForEveryPenumbraOfASourceWithASizeAndNoMoreThanAskedForOfAnyOther) {
    const FilterRow& soft = filter_row(ShadowFilter::pcss_moments);
    EXPECT_EQ(prefilter_settings(soft, {}, 1024).levels, 1u);
    EXPECT_EQ(prefilter_settings(soft, tuned({.levels = 3}), 1024).levels, 3u);
    for (const LightKind kind : {LightKind::directional, LightKind::spot}) {
        LightItem light;
        light.kind = kind;
        light.source_radius_m = light.sun_radius_rad = 0.02f;
        for (const std::uint32_t size : {16u, 64u, 512u, 1024u, 4096u}) {
            const PrefilterSettings demand = prefilter_settings(soft, light, size);
            const float widest = filter_settings(soft, light, size).most_spread_texel;
            const auto coarsest = static_cast<float>(1u << (demand.levels - 1));
            EXPECT_TRUE(coarsest <= widest && widest < 2.0f * coarsest) << size;
            EXPECT_EQ(demand.reach_texel, 0.0f) << "the bias is for what is read, not for the widest";
            EXPECT_FALSE(demand.cut);
        }
        EXPECT_EQ(prefilter_settings(filter_row(ShadowFilter::moments), light, 1024).levels, 1u);
        for (const float absurd : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -1.0f}) {
            (kind == LightKind::directional ? light.sun_radius_rad : light.source_radius_m) = absurd;
            EXPECT_EQ(prefilter_settings(soft, light, 1024).levels, 1u) << absurd;
        }
    }
}

TEST(Moments, TellWhereACasterIsAndHowMuchOfTheRegionItCovers) {
    const Of<shader::Moments, ShadowFilter::moments> whole(32);
    shader::Moments shader;
    for (const double covered : {0.1, 0.5, 0.9})
        for (const double at : {0.2, 0.5}) {
            const auto before = shader.moments_before(whole.stored({{at, covered}, {0.8, 1.0 - covered}}), 0.8, whole.settings());
            EXPECT_NEAR(before.x.value, covered, 0.01);
            EXPECT_NEAR(before.y.value, at, 0.01);
        }
    const auto none = shader.moments_before(whole.stored({{0.8, 1.0}}), 0.8, whole.settings());
    EXPECT_NEAR(none.x.value, 0.0f, 0.01f);
    const auto all = shader.moments_before(whole.stored({{0.2, 0.5}, {0.4, 0.5}}), 0.8, whole.settings());
    EXPECT_NEAR(all.x.value, 1.0f, 0.01f);
    EXPECT_NEAR(all.y.value, 0.3f, 0.01f) << "two: their mean";
}

TEST(BlurWeights, SumUpToOneAndFallFromTheMiddle) {
    for (std::uint32_t size = 1; size <= kMostFilterSize; size += 2) {
        const auto weights = blur_weights(size);
        double sum = static_cast<double>(weights[0]);
        for (std::uint32_t i = 1; i < kMomentWeights; ++i) {
            sum += 2.0 * static_cast<double>(weights[i]);
            EXPECT_LE(weights[i], weights[i - 1]);
            EXPECT_EQ(weights[i] > 0.0f, i <= size / 2) << size;
        }
        EXPECT_NEAR(sum, 1.0, 1e-6);
    }
}

}  // namespace
}  // namespace gnomon::shadow
