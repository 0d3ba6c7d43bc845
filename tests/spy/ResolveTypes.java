import java.io.ByteArrayInputStream;
import java.io.DataInputStream;
import java.io.EOFException;
import java.util.TreeMap;
import lcm.logging.Log;
import lcm.spy.LCMTypeDatabase;

/**
 * ResolveTypes LOG TYPE...: finds each type by its fingerprint as lcm-spy does, and decodes every message of a log so, to its last
 * byte. Prints channels with their types and counts. Exit code 1 when anything cannot be resolved or decoded.
 */
public class ResolveTypes {
  private static final LCMTypeDatabase DATABASE = new LCMTypeDatabase();

  private static void checkType(String name) throws Exception {
    Class<?> type = Class.forName("tern_msgs." + name);
    Class<?> found = DATABASE.getClassByFingerprint(type.getField("LCM_FINGERPRINT").getLong(null));
    if (found != type) throw new IllegalStateException(name + ": its fingerprint resolves to " + found);
  }

  private static String typeOf(Log.Event event) throws Exception {
    DataInputStream bytes = new DataInputStream(new ByteArrayInputStream(event.data));
    bytes.mark(8);
    Class<?> type = DATABASE.getClassByFingerprint(bytes.readLong());
    if (type == null) throw new IllegalStateException(event.channel + ": no type has its fingerprint");
    bytes.reset();
    type.getConstructor(java.io.DataInput.class).newInstance(bytes);
    if (bytes.available() > 0) throw new IllegalStateException(event.channel + ": " + bytes.available() + " bytes are left");
    return type.getSimpleName();
  }

  public static void main(String[] arguments) throws Exception {
    for (int k = 1; k < arguments.length; ++k) checkType(arguments[k]);
    TreeMap<String, Integer> counts = new TreeMap<>();
    Log log = new Log(arguments[0], "r");
    try {
      while (true) {
        Log.Event event = log.readNext();
        if (event.channel.equals("LCM_SELF_TEST")) continue; // liblcm's own, from a process that opens the network
        counts.merge(event.channel + " " + typeOf(event), 1, Integer::sum);
      }
    } catch (EOFException end) {
      counts.forEach((channel, count) -> System.out.println(channel + " " + count));
    }
  }
}
