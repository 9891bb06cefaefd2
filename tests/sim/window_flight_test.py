"""`harrier fly --window` under real X events: keys and mouse, sent by XTest, fly, turn, pause and end the flight.

Usage, on a display: window_flight_test.py HARRIER SCENE. What happened is read off the window's own pixels.
Exit 77 (skipped) without a display or libXtst.
"""
import ctypes
import ctypes.util
import subprocess
import sys
import time

WIDTH, HEIGHT = 160, 90
PATIENCE_S = 60.0
STILL_S = 0.5


class Image(ctypes.Structure):
    _fields_ = [("width", ctypes.c_int), ("height", ctypes.c_int), ("xoffset", ctypes.c_int), ("format", ctypes.c_int),
                ("data", ctypes.POINTER(ctypes.c_ubyte)), ("byte_order", ctypes.c_int), ("unit", ctypes.c_int),
                ("bit_order", ctypes.c_int), ("pad", ctypes.c_int), ("depth", ctypes.c_int),
                ("bytes_per_line", ctypes.c_int), ("bits_per_pixel", ctypes.c_int)]


class Display:
    """One connection, and the window it is about."""

    def __init__(self):
        names = [ctypes.util.find_library(name) for name in ("X11", "Xtst")]
        if None in names:
            raise OSError("no libX11 or libXtst")
        self.x11, self.test = (ctypes.CDLL(name) for name in names)
        for name in ("XOpenDisplay", "XDefaultRootWindow", "XStringToKeysym"):
            getattr(self.x11, name).restype = ctypes.c_void_p if name == "XOpenDisplay" else ctypes.c_ulong
        self.x11.XGetImage.restype = ctypes.POINTER(Image)
        self.display = ctypes.c_void_p(self.x11.XOpenDisplay(None))
        if not self.display:
            raise OSError("no display")
        # A window that is not shown yet cannot be given the focus: asked again.
        self.quiet = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, ctypes.c_void_p)(lambda display, error: 0)
        self.x11.XSetErrorHandler(self.quiet)
        self.root = ctypes.c_ulong(self.x11.XDefaultRootWindow(self.display))
        self.window = None

    def children(self):
        root, parent, count = ctypes.c_ulong(), ctypes.c_ulong(), ctypes.c_uint()
        found = ctypes.POINTER(ctypes.c_ulong)()
        self.x11.XQueryTree(self.display, self.root, ctypes.byref(root), ctypes.byref(parent), ctypes.byref(found),
                            ctypes.byref(count))
        return [found[i] for i in range(count.value)]

    def name_of(self, window):
        name = ctypes.c_char_p()
        self.x11.XFetchName(self.display, ctypes.c_ulong(window), ctypes.byref(name))
        return (name.value or b"").decode()

    def find(self, title):
        for window in self.children():
            if self.name_of(window).startswith(title):
                self.window = ctypes.c_ulong(window)
                self.x11.XSetInputFocus(self.display, self.window, 1, ctypes.c_ulong(0))
                self.x11.XSync(self.display, 0)
                focus, revert = ctypes.c_ulong(), ctypes.c_int()
                self.x11.XGetInputFocus(self.display, ctypes.byref(focus), ctypes.byref(revert))
                return focus.value == window
        return False

    def key(self, name, down):
        code = self.x11.XKeysymToKeycode(self.display, ctypes.c_ulong(self.x11.XStringToKeysym(name.encode())))
        self.test.XTestFakeKeyEvent(self.display, code & 0xFF, int(down), ctypes.c_ulong(0))
        self.x11.XSync(self.display, 0)

    def tap(self, name):
        self.key(name, True)
        self.key(name, False)

    def button(self, down):
        self.test.XTestFakeButtonEvent(self.display, 1, int(down), ctypes.c_ulong(0))
        self.x11.XSync(self.display, 0)

    def pointer(self, x, y):
        self.test.XTestFakeMotionEvent(self.display, -1, x, y, ctypes.c_ulong(0))
        self.x11.XSync(self.display, 0)

    def picture(self):
        image = self.x11.XGetImage(self.display, self.window, 0, 0, WIDTH, HEIGHT, ctypes.c_ulong(0xFFFFFFFF), 2)
        size = image.contents.bytes_per_line * HEIGHT
        pixels = ctypes.string_at(image.contents.data, size)
        ctypes.CDLL(None).free(image.contents.data)
        self.x11.XFree(image)
        return pixels


def wait_for(what, happens):
    end = time.monotonic() + PATIENCE_S
    while time.monotonic() < end:
        if happens():
            print("seen:", what)
            return
        time.sleep(0.05)
    sys.exit("not seen: " + what)


def is_still(display):
    """Whether several pictures in a row are one, and not a blank one."""
    first = display.picture()
    end = time.monotonic() + STILL_S
    while time.monotonic() < end:
        time.sleep(0.1)
        if display.picture() != first:
            return False
    return len(set(first)) > 8


def columns(pixels):
    """Mean brightness of each column above the instruments."""
    rows = range(0, HEIGHT // 2)
    return [sum(pixels[(y * WIDTH + x) * 4 + 1] for y in rows) / len(rows) for x in range(WIDTH)]


def shift_between(before, after):
    """By how many pixels the picture went to the right; negative: to the left."""
    a, b = columns(before), columns(after)

    def mismatch(shift):
        pairs = [(a[x], b[x + shift]) for x in range(WIDTH) if 0 <= x + shift < WIDTH]
        return sum(abs(p - q) for p, q in pairs) / len(pairs)

    return min(range(-WIDTH // 2, WIDTH // 2 + 1), key=mismatch)


def turn(display, what, push, is_right):
    """Pushes until the picture has gone the other way by a few pixels."""
    before = display.picture()

    def has_turned():
        push()
        shift = shift_between(before, display.picture())
        return shift <= -3 if is_right else shift >= 3

    wait_for(what, has_turned)


def drag(display, way):
    display.pointer(WIDTH // 2, HEIGHT // 2)
    time.sleep(0.1)
    display.button(True)
    for step in range(1, 7):
        time.sleep(0.05)
        display.pointer(WIDTH // 2 + way * step, HEIGHT // 2)
    time.sleep(0.1)
    display.button(False)


def check(display):
    wait_for("the window", lambda: display.find("Harrier"))
    blank = display.picture()
    wait_for("the path flies", lambda: display.picture() != blank and not is_still(display))
    display.tap("space")
    wait_for("space stops it", lambda: is_still(display))
    stopped = display.picture()
    display.tap("space")
    wait_for("space lets it go on", lambda: display.picture() != stopped and not is_still(display))
    display.tap("space")
    wait_for("and stops it again", lambda: is_still(display))

    before = display.picture()
    display.key("w", True)
    wait_for("w flies", lambda: display.picture() != before)
    display.key("w", False)
    wait_for("letting it go stops it", lambda: is_still(display))

    for name, is_right in ("Right", True), ("Left", False):
        turn(display, name + " turns the eye", lambda: display.key(name, True), is_right)
        display.key(name, False)
        wait_for("letting it go stops it", lambda: is_still(display))
    for way in 12, -12:
        side = "right" if way > 0 else "left"
        turn(display, "the mouse drawn to the " + side + " turns the eye", lambda: drag(display, way), way > 0)
        wait_for("and no further", lambda: is_still(display))
    display.tap("Escape")


def main():
    try:
        display = Display()
    except OSError as reason:
        print("skipped:", reason)
        return 77
    program = subprocess.Popen([sys.argv[1], "fly", sys.argv[2], "--window", "--size", f"{WIDTH}x{HEIGHT}", "--rate", "30",
                                "--ops", "300", "--triangles", "6000", "--glide", "0"], stdout=subprocess.DEVNULL)
    try:
        check(display)
        status = program.wait(PATIENCE_S)
        print("escape ends it:", status)
        return status
    finally:
        program.kill()


if __name__ == "__main__":
    sys.exit(main())
