// Models that pages carry are read as they were written, or are refused. Damaged models do visible
// harm only in the build with sanitizers.
#include "run/domain/carried_model.h"

#include "core/file.h"
#include "surface/cell_file.h"
#include "unit/run/model_runs.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

namespace cascade::test {
namespace {

class CarriedModelTest : public ::testing::Test {
protected:
    CarriedModelTest() : run_((write(), script())) {}
    ~CarriedModelTest() override { std::filesystem::remove(path()); }

    static std::filesystem::path path() { return "carried_model_test.obj"; }
    static void write() {
        ASSERT_TRUE(write_file(path(),
                               "v 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\n"
                               "vt 0 0\nvt 1 0\nvt 0 1\n"
                               "f 1/1 3/2 5/3\nf 3/1 2/2 5/3\nf 2/1 4/2 5/3\nf 4/1 1/2 5/3\n"
                               "f 3/1 1/2 6/3\nf 2/1 3/2 6/3\nf 4/1 2/2 6/3\nf 1/1 4/2 6/3\n"));
    }
    static std::string script() {
        return "domain { mesh: \"carried_model_test.obj\"; cells: vertices }\n"
               "system s { u: x; u' = lap(u) }\nstage one: s { iterations: 9 }\n";
    }

    const ModelCells& model() { return *run_.simulation().domain().model->cells; }
    std::string bytes() { return print_carried_model(model()); }
    std::shared_ptr<const ModelCells> linked(CarriedModel carried) {
        return link_carried_model(*run_.script().program, std::move(carried));
    }
    /// Expects that the bytes are refused or describe cells that can be linked.
    void expect_sound(const std::string& bytes) {
        auto carried = parse_carried_model(bytes);
        if (!carried) return;
        const std::size_t count = carried->cells.places.size();
        EXPECT_LE(count, bytes.size());
        EXPECT_EQ(linked(*std::move(carried))->count(), count);
    }

    ModelRun run_;
};

TEST_F(CarriedModelTest, ComesBackAsItWas) {
    auto carried = parse_carried_model(bytes());
    ASSERT_TRUE(carried) << carried.error().message;
    const auto again = linked(*std::move(carried));
    EXPECT_EQ(print_carried_model(*again), bytes());
    EXPECT_EQ(again->count(), 6U);
    EXPECT_EQ(again->mesh.texture.size(), 8U);
    EXPECT_EQ(again->spread().order, model().spread().order);
    EXPECT_EQ(again->spread().unit, model().spread().unit);
}

TEST_F(CarriedModelTest, CutModelsAreRefused) {
    const std::string all = bytes();
    for (std::size_t size = 0; size < all.size(); ++size) {
        ASSERT_FALSE(parse_carried_model(all.substr(0, size))) << size;
    }
    EXPECT_FALSE(parse_carried_model(all + '0'));
}

TEST_F(CarriedModelTest, FlippedBitsCrashNothing) {
    const std::string all = bytes();
    for (std::size_t k = 0; k < all.size() * 8; ++k) {
        std::string changed = all;
        changed[k / 8] = static_cast<char>(changed[k / 8] ^ (1 << k % 8));
        expect_sound(changed);
    }
}

TEST_F(CarriedModelTest, AbsurdLengthsAreNotBelieved) {
    const std::string all = bytes();
    for (const std::uint64_t length : {UINT64_MAX, UINT64_MAX / 24 + 1, std::uint64_t{1} << 40}) {
        for (std::size_t at = 8; at + sizeof length <= all.size(); ++at) {
            std::string changed = all;
            std::memcpy(changed.data() + at, &length, sizeof length);
            expect_sound(changed);
        }
    }
}

TEST_F(CarriedModelTest, AModelWithoutCellsIsRefused) {
    CarriedModel carried = *parse_carried_model(bytes());
    const std::string cells = print_cells(carried.cells, {});
    std::string changed = bytes();
    changed.resize(changed.size() - cells.size());
    EXPECT_FALSE(parse_carried_model(changed + print_cells({}, {})));
}

}  // namespace
}  // namespace cascade::test
