"""What a debug view of depth maps looks like, for the tests that look at one."""

TITLE = 20  # pixels at the top for the view's title


class Region:
    """Pixels of a rectangle, x and y of its upper left corner; labels in its upper part are left out."""

    def __init__(self, picture, x, y, width, height):
        px = picture.rgba
        self.pixels = []
        for row in range(int(y + 0.25 * height), int(y + height)):
            for column in range(int(x), int(x + width)):
                i = 4 * (row * picture.width + column)
                self.pixels.append((px[i], px[i + 1], px[i + 2]))

    def share(self, wanted):
        return sum(1 for p in self.pixels if wanted(p)) / float(len(self.pixels))

    def shades(self):
        return len(set(p for p in self.pixels if grey(p)))


def grey(p):
    return p[0] == p[1] == p[2]


def nothing(p):
    return p[2] > 2 * p[1] > 2 * p[0]


def background(p):
    return grey(p) and 20 < p[0] < 32
