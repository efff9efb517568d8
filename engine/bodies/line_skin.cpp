#include "line_skin.h"

#include "../../shapes/manifold_batch.h"
#include "../state/shape.h"

namespace swept::inline SWEPT_PRECISION {

Polygon givenPolygon(const Shape& shape) {
    Polygon polygon = shape.polygon;
    if (shape.isLine) { polygon.radius = 0; }
    return polygon;
}

void setSkin(Shape& shape, bool isDynamic) {
    shape.polygon = givenPolygon(shape);
    shape.isLine = shape.polygon.count == 2 && !(shape.polygon.radius > 0);
    shape.extent = extentOf(shape.polygon);
    if (shape.isLine && isDynamic && !shape.def.sensor) { shape.polygon.radius = kSkinRatio * shape.extent; }
    shape.size = radiusAbout(shape.polygon, {});
    shape.isBatched = collidesInBatches(shape.polygon);
}

}  // namespace swept::inline SWEPT_PRECISION
