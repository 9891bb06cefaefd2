#include "data/geodetic_transform.h"

#include <ogr_spatialref.h>

#include <limits>
#include <mutex>
#include <numbers>
#include <vector>

#include "data/gdal_border.h"

namespace data {

namespace {

struct TransformDestroyer {
    void operator()(OGRCoordinateTransformation* t) const { OGRCoordinateTransformation::DestroyCT(t); }
};
using TransformPtr = std::unique_ptr<OGRCoordinateTransformation, TransformDestroyer>;

void apply(OGRCoordinateTransformation& transform, std::span<glm::dvec2> points) {
    const GdalMessages quiet;
    std::vector<double> x(points.size()), y(points.size());
    std::vector<int> is_valid(points.size(), 0);
    for (size_t i = 0; i < points.size(); ++i) {
        x[i] = points[i].x;
        y[i] = points[i].y;
    }
    transform.Transform(static_cast<int>(points.size()), x.data(), y.data(), nullptr, is_valid.data());
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    for (size_t i = 0; i < points.size(); ++i)
        points[i] = is_valid[i] ? glm::dvec2(x[i], y[i]) : glm::dvec2(kNaN);
}

}  // namespace

struct GeodeticTransform::State {
    CrsKind kind = CrsKind::kNone;
    double full_turn = 0.0;
    TransformPtr degrees_from_crs, crs_from_degrees;
    std::mutex mutex;  // PROJ's objects serve one thread at a time
};

GeodeticTransform::GeodeticTransform(std::unique_ptr<State> state) : state_(std::move(state)) {}
GeodeticTransform::GeodeticTransform(GeodeticTransform&&) noexcept = default;
GeodeticTransform& GeodeticTransform::operator=(GeodeticTransform&&) noexcept = default;
GeodeticTransform::~GeodeticTransform() = default;

lod::Result<GeodeticTransform> GeodeticTransform::make(const std::string& crs) {
    const GdalMessages messages;
    auto state = std::make_unique<State>();
    if (crs.empty()) return GeodeticTransform(std::move(state));

    OGRSpatialReference source, wgs84;
    if (source.SetFromUserInput(crs.c_str()) != OGRERR_NONE) {
        return lod::Error{"CRS not understood: " + messages.text("no WKT") +
                          "; expected a geographic or projected one"};
    }
    if (source.IsLocal()) return GeodeticTransform(std::move(state));
    const bool is_on_ellipsoid = (source.IsGeographic() || source.IsProjected()) && !source.IsGeocentric();
    if (!is_on_ellipsoid) return lod::Error{"CRS is of another kind; expected a geographic or projected one"};
    source.StripVertical();
    source.DemoteTo2D(nullptr);
    source.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    wgs84.SetWellKnownGeogCS("WGS84");
    wgs84.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    state->kind = source.IsGeographic() ? CrsKind::kGeographic : CrsKind::kProjected;
    if (source.IsGeographic()) state->full_turn = 2.0 * std::numbers::pi / source.GetAngularUnits(nullptr);
    state->degrees_from_crs.reset(OGRCreateCoordinateTransformation(&source, &wgs84));
    state->crs_from_degrees.reset(OGRCreateCoordinateTransformation(&wgs84, &source));
    if (!state->degrees_from_crs || !state->crs_from_degrees) {
        return lod::Error{"CRS cannot be taken to WGS84: " + messages.text("no transformation is known") +
                          "; expected one that PROJ can transform"};
    }
    return GeodeticTransform(std::move(state));
}

CrsKind GeodeticTransform::kind() const {
    return state_->kind;
}

double GeodeticTransform::full_turn() const {
    return state_->full_turn;
}

void GeodeticTransform::degrees_from_crs(std::span<glm::dvec2> points) const {
    CHECK(state_->degrees_from_crs);
    const std::lock_guard lock(state_->mutex);
    apply(*state_->degrees_from_crs, points);
}

void GeodeticTransform::crs_from_degrees(std::span<glm::dvec2> points) const {
    CHECK(state_->crs_from_degrees);
    const std::lock_guard lock(state_->mutex);
    apply(*state_->crs_from_degrees, points);
}

}  // namespace data
