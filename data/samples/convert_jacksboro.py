#!/usr/bin/python3
"""Writes jacksboro.tif from the elevation sample of Debian's package python-matplotlib-data.

Needs the Debian packages python-matplotlib-data, python3-numpy and python3-gdal.

    ./convert_jacksboro.py [SOURCE.npz] [TARGET.tif]

The sample is a cut of SRTM3: 344 rows of 403 heights in metres, row 0 in the north. Its xmin, xmax, dx and dy
are degrees; its ymin and ymax are swapped: ymin holds the northern edge. The bounds are those of the outer edges
of the pixels (xmax - xmin is 403 dx), so that the file is pixel-is-area.
"""
import sys

import numpy
from osgeo import gdal, osr

SOURCE = "/usr/share/matplotlib/mpl-data/sample_data/jacksboro_fault_dem.npz"


def convert(source, target):
    sample = numpy.load(source)
    elevation = sample["elevation"]
    west, north = float(sample["xmin"]), max(float(sample["ymin"]), float(sample["ymax"]))
    dx, dy = float(sample["dx"]), float(sample["dy"])
    rows, cols = elevation.shape
    if elevation.dtype != numpy.int16 or abs(float(sample["xmax"]) - west - cols * dx) > 1e-9:
        sys.exit(f"{source}: not the expected sample, expected int16 heights and pixel-edge bounds")
    earth = osr.SpatialReference()
    earth.ImportFromEPSG(4326)
    options = ["COMPRESS=DEFLATE", "PREDICTOR=2", "ZLEVEL=9"]
    raster = gdal.GetDriverByName("GTiff").Create(target, cols, rows, 1, gdal.GDT_Int16, options)
    raster.SetGeoTransform((west, dx, 0.0, north, 0.0, -dy))
    raster.SetProjection(earth.ExportToWkt())
    raster.SetMetadataItem("AREA_OR_POINT", "Area")
    raster.GetRasterBand(1).SetUnitType("m")
    raster.GetRasterBand(1).WriteArray(elevation)
    raster = None


if __name__ == "__main__":
    convert(sys.argv[1] if len(sys.argv) > 1 else SOURCE, sys.argv[2] if len(sys.argv) > 2 else "jacksboro.tif")
