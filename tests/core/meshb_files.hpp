#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Composes valid and invalid `.meshb` files byte by byte, independently of the code under test.
namespace octetra::test {

class MeshbFile {
public:
    explicit MeshbFile(int version = 2, bool swapped = false)
        : version_(version), swapped_(swapped) {
        put<std::int32_t>(1);
        put<std::int32_t>(version);
    }

    template <class T>
    MeshbFile& put(T number) {
        std::string bytes(sizeof number, '\0');
        std::memcpy(bytes.data(), &number, sizeof number);
        if (swapped_) std::ranges::reverse(bytes);
        bytes_ += bytes;
        return *this;
    }
    MeshbFile& integer(std::int64_t number) {
        return version_ < 4 ? put(static_cast<std::int32_t>(number)) : put(number);
    }
    MeshbFile& real(double number) {
        return version_ < 2 ? put(static_cast<float>(number)) : put(number);
    }
    MeshbFile& position(std::int64_t number) {
        return version_ < 3 ? put(static_cast<std::int32_t>(number)) : put(number);
    }

    /// Starts a section, and corrects the position of the next keyword in the previous one.
    MeshbFile& keyword(std::int32_t code) {
        if (next_at_ != 0) set_next(size());
        keyword_at_ = size();
        put(code);
        next_at_ = size();
        return position(0);
    }
    MeshbFile& section(std::int32_t code, std::int64_t count) {
        return keyword(code).integer(count);
    }
    /// Sets the position of the next keyword in this section.
    MeshbFile& set_next(std::size_t position_of_next) {
        const std::string whole = std::exchange(bytes_, {});
        position(static_cast<std::int64_t>(position_of_next));
        const std::string number = std::exchange(bytes_, whole);
        bytes_.replace(next_at_, number.size(), number);
        return *this;
    }

    MeshbFile& dimension(std::int32_t number = 3) { return keyword(3).put(number); }
    MeshbFile& point(double x, double y, double z, std::int64_t reference) {
        return real(x).real(y).real(z).integer(reference);
    }
    MeshbFile& row(const std::vector<std::int64_t>& numbers) {
        for (const std::int64_t number : numbers) integer(number);
        return *this;
    }
    /// The corners of a cell with edges along the axes.
    MeshbFile& corner() {
        return section(4, 4)
            .point(0, 0, 0, 7)
            .point(1, 0, 0, 0)
            .point(0, 1, 0, 0)
            .point(0, 0, 1, -2);
    }
    MeshbFile& cell() { return section(8, 1).row({1, 2, 3, 4, 5}); }
    /// The last keyword.
    MeshbFile& end() { return keyword(54); }

    [[nodiscard]] std::size_t size() const { return bytes_.size(); }
    [[nodiscard]] std::size_t keyword_at() const { return keyword_at_; }
    [[nodiscard]] const std::string& bytes() const { return bytes_; }

private:
    int version_;
    bool swapped_;
    std::string bytes_;
    std::size_t keyword_at_ = 0;
    std::size_t next_at_ = 0;
};

}  // namespace octetra::test
