#include "systems/lookup/lookup_table.h"

#include <algorithm>
#include <cstring>

#include "systems/shadow/request/filter_table.h"
#include "systems/shadow/request/map_textures.h"

namespace gnomon::lookup {
namespace {

using shadow::FilterRow;
using shadow::LightingLight;

constexpr std::string_view kSun = "LIGHT_DIRECTIONAL", kSpot = "LIGHT_SPOT";

/// Returns the filter with that file; null: none has.
const FilterRow* filter_of(std::string_view file) {
    const auto rows = shadow::filter_table();
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const FilterRow& r) { return r.file == file; });
    return row == rows.end() ? nullptr : &*row;
}

}  // namespace

const char* to_text(LookupStatus status) {
    switch (status) {
        case LookupStatus::own_filter:
            return "it is looked up by its own filter";
        case LookupStatus::nearest_filter:
            return "it is looked up by the nearest filter that the text has";
        case LookupStatus::unshadowed:
            return "it has no shadow in this frame";
        case LookupStatus::rays_alone:
            return "it has rays alone, which only a mask can use";
        case LookupStatus::not_shared:
            return "its map lies in no shared array";
        case LookupStatus::no_row:
            return "the text has no row for its map";
        case LookupStatus::no_unit:
            return "the text has too few texture units for its map";
    }
    return "";
}

LookupTable::LookupTable(gl::Device& device, const LookupBindings& bindings, const LookupRows& rows)
    : device_(device),
      bindings_(bindings),
      filters_(rows.filters.begin(), rows.filters.end()),
      rows_(rows),
      buffer_(device, "lights to look up", true) {
    rows_.filters = filters_;
    units_.resize(units_of(bindings).arrays);
}

LookupTable::~LookupTable() {
    device_.destroy(sampler_);
    device_.destroy(no_depths_);
    device_.destroy(no_triangles_);
}

/// Makes what is missing of the sampler and the textures of empty units.
bool LookupTable::provide_objects() {
    const auto texel = [&](gl::TextureHandle& texture, gl::Format format) {
        if (!texture)
            texture = device_.create_texture({.label = "no map", .kind = gl::TextureKind::array, .format = format}, {})
                          .handle;
        return static_cast<bool>(texture);
    };
    if (!sampler_)
        sampler_ =
            device_.create_sampler({"lookup depths", false, false, false, gl::Wrap::border, gl::Wrap::border}).handle;
    return sampler_ && texel(no_depths_, gl::Format::d32f) && texel(no_triangles_, shadow::kTriangleFormat);
}

/// Finds how a light can be looked up, whatever its array's unit.
LookupTable::Found LookupTable::find(const LightingLight& light) const {
    Found found;
    const bool has_map = !light.plain.row.filter_file.empty() && static_cast<bool>(light.plain.map);
    const FilterRow* own = filter_of(light.row.filter_file);
    if (!own) return found;
    if (!has_map || (light.row.rays && !light.row.sheets)) {
        if (light.row.rays) found.outcome.status = LookupStatus::rays_alone;
        return found;
    }
    found.depths = device_.shared_layers(light.plain.map);
    if (!found.depths.array) {
        found.outcome.status = LookupStatus::not_shared;
        return found;
    }
    // Without masks, its masked triangles would be taken for whole ones.
    const bool whole = light.row.ray_masks && !rows_.masks;
    found.choice = choose_filter(whole ? ShadowFilter::sharp_4x4 : own->id, filters_);
    found.choice.alike = found.choice.alike && !whole;
    const FilterRow& row = shadow::filter_row(found.choice.filter);
    if (row.storage.triangle_ids) found.triangles = device_.shared_layers(light.triangles);
    const bool lacks = row.storage.triangle_ids && !found.triangles.array;
    if (lacks || !has_kind(rows_, lookup_kind(light.plain.row))) {
        found = {};
        found.outcome.status = LookupStatus::no_row;
        return found;
    }
    const bool keeps_reach = found.choice.alike || row.width == shadow::FilterWidth::size;
    found.reach_texel = keeps_reach ? light.row.reach_texel : row.reach_texel;
    found.outcome = {found.choice.alike ? LookupStatus::own_filter : LookupStatus::nearest_filter, row.id};
    return found;
}

/// Frees units with arrays that no light needs in this frame.
void LookupTable::keep_units() {
    for (Unit& unit : units_) {
        unit.reads_depths = unit.reads_triangles = false;
        for (const Found& found : found_) {
            const bool same = found.depths.array && found.depths.array == unit.depths;
            unit.reads_depths = unit.reads_depths || same;
            unit.reads_triangles = unit.reads_triangles || (same && found.triangles.array == unit.triangles);
        }
        if (!unit.reads_depths) unit.depths = {};
        if (!unit.reads_triangles) unit.triangles = {};
    }
}

/// Returns the unit of these arrays; -1: none is left. `triangles`: {0} where none are read.
int LookupTable::take_unit(gl::TextureHandle depths, gl::TextureHandle triangles) {
    const auto serves = [&](const Unit& unit) {
        const bool fits = !triangles || !unit.triangles || unit.triangles == triangles;
        return unit.depths == depths && fits;
    };
    auto unit = std::find_if(units_.begin(), units_.end(), serves);
    if (unit == units_.end())
        unit = std::find_if(units_.begin(), units_.end(), [](const Unit& u) { return !u.depths; });
    if (unit == units_.end()) return -1;
    unit->depths = depths;
    if (triangles) unit->triangles = triangles;
    return static_cast<int>(unit - units_.begin());
}

void LookupTable::write(const LightingLight& light, const Found& found, LookupOutcome& outcome, LookupRecord& record) {
    record = {};
    record.light = light.record;
    outcome = found.outcome;
    const bool sun = light.row.kind_define == kSun, spot = light.row.kind_define == kSpot;
    record.row.z = (sun ? 1 : 0) + (spot ? 2 : 0);
    record.place.x = -1;
    if (outcome.filter == ShadowFilter::automatic) return;
    const int unit = take_unit(found.depths.array, found.triangles.array);
    if (unit < 0) {
        outcome = {LookupStatus::no_unit, ShadowFilter::automatic};
        return;
    }
    if (found.choice.one_tap) record.light.filtering = {1, 1, 0, record.light.filtering.w};
    if (found.choice.without_source) record.light.radiance.w = 0.0f;
    const bool reads_depths = shadow::filter_row(outcome.filter).reading == shadow::MapReading::depths;
    record.row.x = static_cast<int>(lookup_kind(light.plain.row));
    record.row.y = static_cast<int>(std::find(filters_.begin(), filters_.end(), outcome.filter) - filters_.begin());
    record.row.z += reads_depths ? 4 : 0;
    record.place = {unit, static_cast<int>(found.depths.first), static_cast<int>(found.triangles.first),
                    static_cast<int>(light.record.moment_sampling.w)};
    record.sizes = {found.reach_texel, static_cast<float>(found.depths.width), 0.0f, 0.0f};
}

bool LookupTable::update(const shadow::LightingInputs& inputs, const GpuScene& gpu, gl::CommandList& list,
                         std::uint32_t noise_round) {
    const std::size_t count = inputs.lights.size();
    found_.clear();
    for (const LightingLight& light : inputs.lights) found_.push_back(find(light));
    keep_units();
    outcomes_.resize(count);
    bytes_.resize(sizeof(LookupHead) + count * sizeof(LookupRecord));
    const LookupHead head{inputs.camera, {static_cast<int>(count), 0, 0, 0}};
    std::memcpy(bytes_.data(), &head, sizeof head);
    for (std::size_t i = 0; i < count; ++i) {
        LookupRecord record;
        write(inputs.lights[i], found_[i], outcomes_[i], record);
        record.light = shadow::in_round(record.light, noise_round);
        std::memcpy(bytes_.data() + sizeof head + i * sizeof record, &record, sizeof record);
    }
    const gl::BufferHandle before = buffer_.handle();
    if (!provide_objects() || !buffer_.reserve(bytes_.size())) {
        uploaded_.clear();
        return false;
    }
    if (buffer_.handle() != before || bytes_ != uploaded_) {
        list.update(buffer_.handle(), 0, std::span<const std::byte>(bytes_));
        uploaded_ = bytes_;
    }
    list_bindings(gpu);
    return true;
}

void LookupTable::list_bindings(const GpuScene& gpu) {
    textures_.clear();
    const LookupUnits units = units_of(bindings_);
    for (std::uint32_t i = 0; i < units.arrays; ++i) {
        const Unit& unit = units_[i];
        textures_.push_back({units.first_depths + i, unit.depths ? unit.depths : no_depths_, sampler_});
        textures_.push_back({units.first_triangles + i, unit.triangles ? unit.triangles : no_triangles_, {}});
    }
    texels_.clear();
    texels_.push_back({units.first_texels, buffer_.handle()});
    texels_.push_back({units.first_texels + 1, gpu.instances()});
    texels_.push_back({units.first_texels + 2, gpu.caster_triangles()});
    storage_.clear();
    storage_.push_back({bindings_.storage_binding, gpu.caster_masks()});
}

void LookupTable::bind(gl::CommandList& list) const {
    for (const LookupTexture& texture : textures_)
        list.add(gl::BindTexture{texture.unit, texture.texture, texture.sampler});
    for (const LookupTexels& texels : texels_)
        if (texels.buffer) list.add(gl::BindTexels{texels.unit, texels.buffer});
    for (const LookupStorage& storage : storage_)
        if (storage.buffer) list.add(gl::BindStorage{storage.binding, storage.buffer});
}

}  // namespace gnomon::lookup
