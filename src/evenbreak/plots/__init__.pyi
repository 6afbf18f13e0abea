from .contours import breaks_figure as breaks_figure
from .contours import draw_shots as draw_shots
from .diagram import draw as draw
from .picture import Picture as Picture
from .picture import image_bytes as image_bytes
from .traced_shot import shot_on_table as shot_on_table
