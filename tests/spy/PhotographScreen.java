import java.awt.Rectangle;
import java.awt.Robot;
import java.awt.Toolkit;
import java.awt.image.BufferedImage;
import java.io.File;
import javax.imageio.ImageIO;

/**
 * PhotographScreen FILE ROWS: waits until the screen shows a table of so many rows, white with lines between, and writes it as a PNG.
 */
public class PhotographScreen {
  private static final int WHITE_PIXELS_OF_A_ROW = 400;

  /** Above the button at the window's foot. */
  private static final int FOOT = 560;

  private static int rows(BufferedImage image) {
    int rows = 0;
    boolean inside = false;
    for (int y = 0; y < FOOT; ++y) {
      int white = 0;
      for (int x = 0; x < image.getWidth(); ++x) white += (image.getRGB(x, y) & 0xffffff) == 0xffffff ? 1 : 0;
      if (white >= WHITE_PIXELS_OF_A_ROW && !inside) ++rows;
      inside = white >= WHITE_PIXELS_OF_A_ROW;
    }
    return rows;
  }

  public static void main(String[] arguments) throws Exception {
    Robot robot = new Robot();
    Rectangle screen = new Rectangle(Toolkit.getDefaultToolkit().getScreenSize());
    BufferedImage image;
    do {
      robot.delay(200);
      image = robot.createScreenCapture(screen);
    } while (rows(image) < Integer.parseInt(arguments[1]));
    ImageIO.write(image, "png", new File(arguments[0]));
  }
}
