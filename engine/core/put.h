#pragma once

namespace gnomon {

/// Writes a field. Returns true if its value changed, NaN included.
template <class T>
bool put(T& field, const T& value) {
    const bool same = field == value;
    field = value;
    return !same;
}

}  // namespace gnomon
